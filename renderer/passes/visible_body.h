#pragma once

#include <glm/glm.hpp>
#include <vector>

#include <halfsilver/bounds.h>
#include <halfsilver/scene.h>

namespace halfsilver {

// The part of the scene's bounds that a camera sees, a convex body. Coordinates are relative to Scene::origin.
struct VisibleBody {
  std::vector<glm::vec3> corners;  // among them all of the body's; none if there is nothing to see
  glm::vec3 eye{0}, forward{0};    // the latter of length 1

  bool operator==(const VisibleBody&) const = default;
};

// `aspect`: width over height. Parallel cameras have no body: nothing is nearer to them than the rest.
VisibleBody visibleBody(const Camera& camera, float aspect, const Bounds& bounds);

// A view of the body along a light's direction, in which what is near the eye is larger (Wimmer, Scherzer and
// Purgathofer 2004, light-space perspective shadow maps): a perspective whose planes of equal distance stand in the
// light's direction, so that its rays stay parallel. All that lies before the body, seen from the light, is part of its
// depth. `size`: texels along a side, of which `margin` on each side are left to filters.
glm::mat4 fitLightSpace(const Bounds& bounds, const VisibleBody& body, const glm::vec3& direction, int size,
                        int margin);

}  // namespace halfsilver
