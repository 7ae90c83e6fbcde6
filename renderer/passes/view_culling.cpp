#include "passes/view_culling.h"

namespace halfsilver {

Frustum::Frustum(const glm::mat4& worldToClip) {
  const glm::mat4 rows = glm::transpose(worldToClip);
  for (int axis = 0; axis < 3; ++axis) {
    planes_[2 * static_cast<std::size_t>(axis)] = rows[3] + rows[axis];
    planes_[2 * static_cast<std::size_t>(axis) + 1] = rows[3] - rows[axis];
  }
}

bool Frustum::mayTouch(const Bounds& bounds) const {
  if (bounds.empty()) return false;
  const glm::vec3 largest = glm::max(glm::abs(bounds.low), glm::abs(bounds.high));
  for (const glm::vec4& plane : planes_) {
    const glm::vec3 normal(plane);
    const glm::vec3 farthest = glm::mix(bounds.low, bounds.high, glm::greaterThan(normal, glm::vec3(0)));
    // The device rounds, too: what lies beside the view by less than that is drawn.
    constexpr float kRounding = 1e-5f;
    const float slack = kRounding * (glm::dot(glm::abs(normal), largest) + std::abs(plane.w));
    if (glm::dot(normal, farthest) + plane.w < -slack) return false;
  }
  return true;
}

VertexRuns visibleRuns(std::span<const DrawCluster> clusters, const Frustum& frustum, bool cut) {
  VertexRuns runs;
  std::uint32_t end = 0;  // of the last run, triangles
  for (const DrawCluster& cluster : clusters) {
    if (cluster.cut != cut || !frustum.mayTouch(cluster.bounds)) continue;
    const auto vertices = static_cast<std::int32_t>(3 * cluster.count);
    if (!runs.firsts.empty() && end == cluster.first) {
      runs.counts.back() += vertices;
    } else {
      runs.firsts.push_back(static_cast<std::int32_t>(3 * cluster.first));
      runs.counts.push_back(vertices);
    }
    end = cluster.first + cluster.count;
    runs.triangles += cluster.count;
  }
  return runs;
}

}  // namespace halfsilver
