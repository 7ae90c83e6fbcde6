#pragma once

#include <glm/glm.hpp>

#include "core/bounds.h"
#include "gl/program.h"

namespace halfsilver {

// The space of the voxel grid and the A-buffers: the scene's bounds, padded, as a unit cube. Every axis has the same
// number of voxels and of texels, so both follow the scene's shape.
struct Grid {
  glm::vec3 low{0};     // relative to Scene::origin
  glm::vec3 extent{1};  // metres
  int voxels = 1;       // along each axis
  int texels = 1;       // of the A-buffers, along each axis
  int slabs = 1;        // lists a texel, each for its share of the depth

  float texelSize() const { return glm::max(extent.x, glm::max(extent.y, extent.z)) / static_cast<float>(texels); }
  // Sets the uniforms of shaders/tracing/grid.glsl.
  void apply(const gl::Program& program) const;
};

// The padding keeps every surface clear of the border, flat scenes included.
Grid makeGrid(const Bounds& bounds, int voxels, int texels, int slabs = 1);

}  // namespace halfsilver
