// Bricks that a moved triangle comes to are marked, and their runs given up. Voxels are whole bricks here.
#include "shared/passes/identity.h"
#include "tracing/common/grid.glsl"
#include "tracing/common/mark_voxel.glsl"
#include "tracing/identity/give_up.glsl"

// Empty cubes that reach the brick are to shrink.
void noteFilled(ivec3 brick) {
  uvec3 below = uvec3(FILLED_BELOW - brick), above = uvec3(brick + 1);
  atomicMax(brickWork.filledBelowX, below.x);
  atomicMax(brickWork.filledBelowY, below.y);
  atomicMax(brickWork.filledBelowZ, below.z);
  atomicMax(brickWork.filledAboveX, above.x);
  atomicMax(brickWork.filledAboveY, above.y);
  atomicMax(brickWork.filledAboveZ, above.z);
}

// `axis`: the one that the triangle is seen along.
void markMoved(ivec3 brick, int axis) {
  markVoxel(brick, 1u << uint(axis) | VOXEL_MOVED);
  if (giveUp(voxelIndex(brick))) noteFilled(brick);
}
