#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include <halfsilver/bounds.h>
#include <halfsilver/draw_clusters.h>
#include "passes/visible_body.h"

namespace halfsilver {

// What the maps of a directional light show beside the whole scene, whose texels may be too large for what stands in
// it.
struct ShadowBoxes {
  Bounds core;                 // where nearly all triangles are, if a few large ones reach far beyond; else empty
  std::vector<Bounds> around;  // around the eye, one within the next; none if texels are small enough without
  VisibleBody seen;            // for a map in perspective, which stands for those around the eye; else empty

  bool operator==(const ShadowBoxes&) const = default;
};

// `resolution`: texels along a map. `eye`: where the camera is, of parallel rays what it looks at; relative to
// Scene::origin. Boxes move with the eye in steps of an eighth of
// their size, so that maps are kept meanwhile.
ShadowBoxes shadowBoxes(std::span<const DrawCluster> clusters, const Bounds& whole, int resolution,
                        const glm::vec3& eye);

}  // namespace halfsilver
