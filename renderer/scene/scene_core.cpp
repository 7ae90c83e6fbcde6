#include <halfsilver/scene_core.h>

#include <algorithm>
#include <functional>
#include <queue>

namespace halfsilver {
namespace {

constexpr float kWorthwhile = 4;

float longest(const glm::vec3& size) { return glm::max(size.x, glm::max(size.y, size.z)); }

Bounds boundsOf(const Scene& scene, const Triangle& triangle) {
  Bounds bounds;
  for (const std::uint32_t vertex : triangle.vertices) bounds.add(scene.vertices[vertex].position);
  return bounds;
}

}  // namespace

SceneCore findCore(const Scene& scene) {
  SceneCore whole{scene.bounds(), {}};
  if (scene.triangles.size() <= kMaxOuterTriangles) return whole;
  // The sizes of the largest triangles, and of the first that must stay.
  std::priority_queue<float, std::vector<float>, std::greater<>> largest;
  for (const Triangle& triangle : scene.triangles) {
    const float size = longest(boundsOf(scene, triangle).extent());
    if (largest.size() <= kMaxOuterTriangles) {
      largest.push(size);
    } else if (size > largest.top()) {
      largest.pop();
      largest.push(size);
    }
  }
  const float most = largest.top();
  SceneCore core;
  std::vector<std::uint32_t> large;
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    const Bounds bounds = boundsOf(scene, scene.triangles[i]);
    if (longest(bounds.extent()) > most) {
      large.push_back(i);
    } else {
      core.bounds.add(bounds.low);
      core.bounds.add(bounds.high);
    }
  }
  if (kWorthwhile * longest(core.bounds.extent()) > longest(whole.bounds.extent())) return whole;
  for (const std::uint32_t i : large) {
    const Bounds bounds = boundsOf(scene, scene.triangles[i]);
    if (glm::any(glm::lessThan(bounds.low, core.bounds.low)) ||
        glm::any(glm::greaterThan(bounds.high, core.bounds.high)))
      core.outer.push_back(i);
  }
  return core;
}

}  // namespace halfsilver
