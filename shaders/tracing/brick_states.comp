// States of all bricks. BEGIN: empty, or missing where the voxel pass found triangles. FINISH: those that were asked for
// are there now. LEAVE: those that moved triangles came to at the last move are given up, before the next one marks them.
// One invocation a brick.
#include "shared/bindings.h"
#include "shared/structs.h"
#include "tracing/grid.glsl"
#define VOXEL_ACCESS coherent
#include "tracing/voxel_store.glsl"
#define RUN_ACCESS readonly
#include "tracing/bricks.glsl"
#ifdef FINISH
#include "tracing/brick_build.glsl"
#endif
#ifdef LEAVE
#include "tracing/give_up.glsl"
#endif

layout(local_size_x = 64) in;
uniform uint brickCount;

void main() {
  uint brick = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (brick >= brickCount) return;
#ifdef BEGIN
  bricks[brick] = voxelMaskAt(brick) != 0u ? BRICK_MISSING : BRICK_EMPTY;
#endif
#ifdef FINISH
  uint state = bricks[brick];
  if (requested(state)) bricks[brick] = builds[state - BRICK_REQUESTED].run;
#endif
#ifdef LEAVE
  uint moved = VOXEL_MOVED << (VOXEL_BITS * (brick % VOXELS_PER_WORD));
  if ((voxelWords[brick / VOXELS_PER_WORD] & moved) == 0u) return;
  atomicAnd(voxelWords[brick / VOXELS_PER_WORD], ~moved);
  giveUp(brick);
#endif
}
