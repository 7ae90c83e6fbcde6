#include "tracing/identity/run_store.h"

namespace halfsilver {
namespace {

// The lists of a run, as shaders/tracing/identity/bricks.glsl lays them out.
void addVoxels(const Grid& grid, const glm::ivec3& brick, const GLuint* run, std::vector<StructureCell>& voxels) {
  const std::uint64_t occupied = run[0] | static_cast<std::uint64_t>(run[1]) << 32;
  std::uint32_t begin = 0, list = 2;
  for (int number = 0; number < VOXELS_PER_BRICK; ++number) {
    if ((occupied >> number & 1) == 0) continue;
    const glm::ivec3 voxel = glm::ivec3(number, number >> BRICK_SHIFT, number >> (2 * BRICK_SHIFT)) & (BRICK_SIDE - 1);
    const std::uint32_t end = run[list++];
    voxels.push_back({grid.boundsOf(BRICK_SIDE * brick + voxel), end - begin});
    begin = end;
  }
}

}  // namespace

StructureCells RunStore::cells() const {
  StructureCells cells;
  if (!bricks_ || !runs_) return cells;
  const std::vector<GLuint> states = bricks_.read<GLuint>(brickCount()), words = runs_.read<GLuint>(capacity());
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i] >= BRICK_REQUESTED) continue;
    const glm::ivec3 brick = brickGrid_.voxelAt(i);
    const std::size_t before = cells.voxels.size();
    addVoxels(grid_, brick, &words[states[i]], cells.voxels);
    StructureCell& whole = cells.bricks.emplace_back(StructureCell{brickGrid_.boundsOf(brick), 0});
    for (std::size_t voxel = before; voxel < cells.voxels.size(); ++voxel) whole.entries += cells.voxels[voxel].entries;
  }
  return cells;
}

}  // namespace halfsilver
