#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include <halfsilver/scene.h>

namespace halfsilver {

// Whether the triangle has a hole at the barycentrics (weights of the second and third vertex): its base color's
// alpha, read at full resolution, is below the cutoff. Agrees to the bit with cutAway() in shaders/lib/alpha.glsl;
// cheap enough to be called for every candidate of a ray. `blends`: FrameConstants::blends.
bool cutAway(const Scene& scene, std::uint32_t triangle, glm::vec2 barycentrics, bool blends = false);

// Reads all texels of the materials that are not opaque.
struct Translucency {
  std::vector<bool> holes;  // per material: whether cutAway() can be true on any of its triangles, blended or not
  std::uint32_t blending;   // how many materials of AlphaMode::blend are not opaque everywhere
};
Translucency translucencyOf(const Scene& scene);

}  // namespace halfsilver
