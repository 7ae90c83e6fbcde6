#include <halfsilver/scene.h>

#include <algorithm>
#include <cmath>

namespace halfsilver {

bool seenFromBehind(const Material& material) {
  const bool volume = material.transmission > 0 && material.thickness > 0 && !material.unlit && !material.mirror;
  return material.doubleSided || volume;
}

Bounds Scene::bounds() const {
  Bounds bounds;
  for (const Triangle& triangle : triangles)
    for (const std::uint32_t vertex : triangle.vertices) bounds.add(vertices[vertex].position);
  return bounds;
}

Camera frameAll(const Bounds& bounds) {
  constexpr float kNarrowestAspect = 4.0f / 3;  // width over height: what fits into this fits into all wider ones
  constexpr float kMargin = 1.08f;
  Camera camera;
  camera.name = "whole scene";
  if (bounds.empty()) return camera;
  const glm::vec3 back = glm::normalize(glm::vec3(0.55f, 0.4f, 1.0f));  // from the target to the eye
  const glm::vec3 right = glm::normalize(glm::cross(camera.up, back));
  const glm::vec3 up = glm::cross(back, right);
  const float slope = std::tan(0.5f * camera.verticalFov);
  const glm::vec3 half = 0.5f * bounds.extent();
  float distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 p = half * glm::vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const float reach = std::max(std::abs(glm::dot(p, up)), std::abs(glm::dot(p, right)) / kNarrowestAspect);
    distance = std::max(distance, glm::dot(p, back) + reach / slope);
  }
  if (!(distance > 0)) distance = 1;
  camera.target = bounds.center();
  camera.eye = camera.target + kMargin * distance * back;
  return camera;
}

}  // namespace halfsilver
