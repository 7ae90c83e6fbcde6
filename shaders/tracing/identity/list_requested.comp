// Notes the bricks that rays wait for, so that the rest of a build goes over those alone. One invocation per brick.
#include "shared/passes/identity.h"
#include "tracing/identity/brick_build.glsl"
#include "tracing/identity/bricks.glsl"

layout(local_size_x = 64) in;
uniform uint brickCount;

void main() {
  uint brick = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (brick < brickCount && requested(bricks[brick])) builds[bricks[brick] - BRICK_REQUESTED].brick = brick;
}
