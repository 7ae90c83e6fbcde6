#pragma once

#include <cstddef>
#include <glm/glm.hpp>

#include <halfsilver/bounds.h>
#include "gl/program.h"

namespace halfsilver {

// The space of the voxel grid and the A-buffers: the scene's bounds, padded, as a unit cube.
struct Grid {
  glm::vec3 low{0};     // relative to Scene::origin
  glm::vec3 extent{1};  // meters
  glm::ivec3 voxels{1};
  int texels = 1;  // of the A-buffers, along each axis, if they have a raster of their own

  int longestSide() const { return glm::max(voxels.x, glm::max(voxels.y, voxels.z)); }
  std::size_t voxelCount() const {
    return static_cast<std::size_t>(voxels.x) * static_cast<std::size_t>(voxels.y) * static_cast<std::size_t>(voxels.z);
  }

  glm::ivec3 voxelAt(std::size_t index) const {
    const auto i = static_cast<int>(index);
    return {i % voxels.x, i / voxels.x % voxels.y, i / (voxels.x * voxels.y)};
  }
  Bounds boundsOf(const glm::ivec3& voxel) const {
    const glm::vec3 side = extent / glm::vec3(voxels);
    const glm::vec3 corner = low + glm::vec3(voxel) * side;
    return {corner, corner + side};
  }

  bool operator==(const Grid&) const = default;

  float texelSize() const { return glm::max(extent.x, glm::max(extent.y, extent.z)) / static_cast<float>(texels); }
  // Sets the uniforms of shaders/tracing/grid.glsl.
  void apply(const gl::Program& program) const;
};

inline float longestSide(const glm::vec3& extent) { return glm::max(extent.x, glm::max(extent.y, extent.z)); }

// Whether all of the bounds lies in the grid, clear of its border.
bool holds(const Grid& grid, const Bounds& bounds);

// The same number of voxels along every axis, which so follow the scene's shape, as the papers have it. The padding
// keeps every surface clear of the border, flat scenes included.
Grid makeGrid(const Bounds& bounds, int voxels, int texels);
// Voxels of about equal sides, since scenes are not cubes: `wanted` of them in all, but at most `max` along an axis. If
// `wanted` is 0, there are `max` along the longest.
Grid makeCubicGrid(const Bounds& bounds, int max, double wanted);

}  // namespace halfsilver
