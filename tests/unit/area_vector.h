#pragma once

#include <glm/glm.hpp>

#include <halfsilver/scene.h>

namespace halfsilver {

// Along the normal of the front side, with twice the area as length.
inline glm::dvec3 areaVector(const Scene& scene, const Triangle& t) {
  const glm::dvec3 a(scene.vertices[t.vertices[0]].position), b(scene.vertices[t.vertices[1]].position),
      c(scene.vertices[t.vertices[2]].position);
  return glm::cross(b - a, c - a);
}

}  // namespace halfsilver
