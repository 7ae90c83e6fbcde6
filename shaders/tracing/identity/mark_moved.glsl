// Bricks that a moved triangle comes to are marked, and their runs given up. Voxels are whole bricks here.
#include "shared/passes/identity.h"
#include "tracing/common/grid.glsl"
#include "tracing/common/mark_voxel.glsl"
#include "tracing/identity/give_up.glsl"

// `axis`: the one that the triangle is seen along.
void markMoved(ivec3 brick, int axis) {
  markVoxel(brick, 1u << uint(axis) | VOXEL_MOVED);
  giveUp(voxelIndex(brick));
}
