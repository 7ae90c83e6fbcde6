// Bricks that triangles of the last move came to are given up, before the next move marks its own. One invocation per
// brick.
#define VOXEL_ACCESS coherent
#include "shared/passes/identity.h"
#include "shared/tracing.h"
#include "tracing/common/voxel_store.glsl"
#include "tracing/identity/give_up.glsl"

layout(local_size_x = 64) in;
uniform uint brickCount;

void main() {
  uint brick = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (brick >= brickCount) return;
  uint moved = VOXEL_MOVED << (VOXEL_BITS * (brick % VOXELS_PER_WORD));
  if ((voxelWords[brick / VOXELS_PER_WORD] & moved) == 0u) return;
  atomicAnd(voxelWords[brick / VOXELS_PER_WORD], ~moved);
  giveUp(brick);
}
