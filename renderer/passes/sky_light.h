#pragma once

#include <glm/glm.hpp>
#include <vector>

#include <halfsilver/scene.h>

namespace halfsilver {

// A direction that stands for a part of the upper sky.
struct SkyDirection {
  glm::vec3 direction{0, 1, 0};  // unit, towards the sky
  glm::vec3 irradiance{0};       // of the part, on a plane that faces `direction`
};

// The sky as light on diffuse surfaces.
struct SkyLight {
  std::vector<SkyDirection> directions;
  glm::vec3 upper{0};  // irradiance of the upper half on a plane that faces up
  glm::vec3 lower{0};  // irradiance of the lower half on a plane that faces down
};

// Splits the upper half of the sky among `count` well distributed directions (0: none) and integrates each share.
// Each direction points along its share's mean radiance, so a bright sun in an image casts its shadow from the right
// place; the directions together give the exact irradiance of a plane that faces up. Black shares are left out.
SkyLight integrateSky(const Sky& sky, int count);

}  // namespace halfsilver
