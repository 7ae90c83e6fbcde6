// States of bricks before a build (FINISH off: empty, or missing where the voxel pass found triangles) and after one:
// those that were asked for are there. One invocation a brick.
#include "shared/bindings.h"
#include "tracing/grid.glsl"
#define VOXEL_ACCESS readonly
#include "tracing/voxel_store.glsl"
#define RUN_ACCESS readonly
#include "tracing/bricks.glsl"
#include "tracing/brick_build.glsl"

layout(local_size_x = 64) in;
uniform uint brickCount;

void main() {
  uint brick = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (brick >= brickCount) return;
#ifdef FINISH
  uint state = bricks[brick];
  if (requested(state)) bricks[brick] = builds[state - BRICK_REQUESTED].run;
#else
  bricks[brick] = voxelMaskAt(brick) != 0u ? BRICK_MISSING : BRICK_EMPTY;
#endif
}
