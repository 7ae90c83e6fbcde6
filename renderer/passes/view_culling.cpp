#include "passes/view_culling.h"

#include <algorithm>

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
    const float slack = kClipRounding * (glm::dot(glm::abs(normal), largest) + std::abs(plane.w));
    if (glm::dot(normal, farthest) + plane.w < -slack) return false;
  }
  return true;
}

void VertexRuns::add(const DrawCluster& cluster) {
  const auto first = static_cast<std::int32_t>(3 * cluster.first);
  const auto count = static_cast<std::int32_t>(3 * cluster.count);
  triangles += cluster.count;
  if (!firsts.empty() && firsts.back() + counts.back() == first) {
    counts.back() += count;
    return;
  }
  firsts.push_back(first);
  counts.push_back(count);
}

VisibleRuns visibleRuns(std::span<const DrawCluster> clusters, Casters casters, std::span<const Frustum> frusta) {
  VisibleRuns visible;
  for (const DrawCluster& cluster : clusters) {
    if (casters != Casters::all && cluster.moves != (casters == Casters::moving)) continue;
    if (std::any_of(frusta.begin(), frusta.end(), [&](const Frustum& f) { return f.mayTouch(cluster.bounds); }))
      (cluster.cut ? visible.cut : visible.opaque).add(cluster);
  }
  return visible;
}

}  // namespace halfsilver
