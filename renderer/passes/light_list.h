#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include <halfsilver/bounds.h>
#include <halfsilver/products.h>
#include <halfsilver/scene.h>
#include <halfsilver/shared_structs.h>
#include "passes/shadow_boxes.h"

namespace halfsilver {

// Everything that shaders know of light, and what has to be drawn for it.
struct LightList {
  std::vector<shared::GpuLight> lights;  // range after range
  LightRanges ranges;
  std::vector<ShadowView> views;
  int layers = 0;
  std::vector<std::string> warnings;
};

struct LightListLimits {
  int resolution = 1024;     // texels along a layer
  int skyDirections = 12;    // at most
  int layers = 256;          // at most
  bool mapsOfLights = true;  // direct lights cast shadows by maps
};

// Lights with places in the shadow maps: a layer for a directional light or a spot, six for any other, a tile of a
// shared layer for each direction of the sky. If the layers do not suffice, the sky has fewer directions; if
// that is not enough, the last lights cast no shadows. The warnings name both.
//
// A directional light has a layer for each of the `boxes`, of what lies there or casts shadows there, before that of
// the whole scene, or one in perspective of what the camera sees in their place (`boxes.seen`); lights do not begin
// farther away than the core asks for. Spots wider than 80 degrees have six
// layers.
LightList makeLightList(const Bounds& bounds, std::span<const Light> lights, const Sky& sky,
                        const LightListLimits& limits, const ShadowBoxes& boxes = {});

}  // namespace halfsilver
