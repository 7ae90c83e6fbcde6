// Bricks that were asked for are there now. One invocation per brick.
#include "shared/passes/identity.h"
#include "tracing/identity/brick_build.glsl"
#include "tracing/identity/bricks.glsl"

layout(local_size_x = 64) in;
uniform uint brickCount;

void main() {
  uint brick = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (brick >= brickCount) return;
  uint state = bricks[brick];
  if (requested(state)) bricks[brick] = builds[state - BRICK_REQUESTED].run;
}
