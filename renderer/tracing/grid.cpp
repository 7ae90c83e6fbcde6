#include "tracing/grid.h"

namespace halfsilver {

Grid makeGrid(const Bounds& bounds, int voxels, int texels, int slabs) {
  const glm::vec3 extent = bounds.extent();
  const float longest = glm::max(extent.x, glm::max(extent.y, extent.z));
  const float padding = longest > 0 ? 1e-3f * longest : 1.0f;
  Grid grid;
  grid.low = (bounds.empty() ? glm::vec3(0) : bounds.low) - padding;
  grid.extent = extent + 2.0f * padding;
  grid.voxels = voxels;
  grid.texels = texels;
  grid.slabs = slabs;
  return grid;
}

void Grid::apply(const gl::Program& program) const {
  program.set("gridLow", low);
  program.set("gridInverse", 1.0f / extent);
  program.set("voxelResolution", voxels);
  program.set("bufferResolution", texels);
  program.set("depthSlabs", slabs);
}

}  // namespace halfsilver
