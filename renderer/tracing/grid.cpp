#include "tracing/grid.h"

namespace halfsilver {
namespace {

// Of the longest side of the bounds, beyond them.
constexpr float kPadding = 1e-3f;

}  // namespace

Grid makeGrid(const Bounds& bounds, int voxels, int texels) {
  const glm::vec3 extent = bounds.extent();
  const float longest = longestSide(extent);
  const float padding = longest > 0 ? kPadding * longest : 1.0f;
  Grid grid;
  grid.low = (bounds.empty() ? glm::vec3(0) : bounds.low) - padding;
  grid.extent = extent + 2.0f * padding;
  grid.voxels = glm::ivec3(voxels);
  grid.texels = texels;
  return grid;
}

bool holds(const Grid& grid, const Bounds& bounds) {
  if (bounds.empty()) return true;
  const float clear = 0.5f * kPadding * longestSide(bounds.extent());
  return glm::all(glm::greaterThanEqual(bounds.low, grid.low + clear)) &&
         glm::all(glm::lessThanEqual(bounds.high, grid.low + grid.extent - clear));
}

Grid makeCubicGrid(const Bounds& bounds, int max, double wanted) {
  Grid grid = makeGrid(bounds, max, max);
  const glm::vec3 shape = grid.extent / longestSide(grid.extent);
  const auto along = [&](int longest) {
    return glm::clamp(glm::ivec3(glm::ceil(static_cast<float>(longest) * shape)), 1, longest);
  };
  // The coarsest grid with enough voxels: the count grows with the side.
  int low = wanted > 0 ? 1 : max;
  for (int high = max; low < high;) {
    const int middle = (low + high) / 2;
    grid.voxels = along(middle);
    if (static_cast<double>(grid.voxelCount()) < wanted)
      low = middle + 1;
    else
      high = middle;
  }
  grid.voxels = along(low);
  return grid;
}

void Grid::apply(const gl::Program& program) const {
  program.set("gridLow", low);
  program.set("gridInverse", 1.0f / extent);
  program.set("voxelCount", voxels);
  program.set("bufferResolution", texels);
}

}  // namespace halfsilver
