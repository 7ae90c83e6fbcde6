// Begins the builds of the bricks that rays wait for, so that the steps to come go over those alone. One invocation per
// brick.
#include "shared/passes/identity.h"
#include "tracing/identity/brick_build.glsl"
#include "tracing/identity/bricks.glsl"

layout(local_size_x = 64) in;
uniform uint brickCount;

void main() {
  uint brick = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (brick >= brickCount) return;
  uint state = bricks[brick];
  if (!requested(state)) return;
  uint build = state - BRICK_REQUESTED;
  builds[build].brick = brick;
  for (uint i = 0u; i < VOXELS_PER_BRICK; ++i) builds[build].next[i] = 0u;
}
