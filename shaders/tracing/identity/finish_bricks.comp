// Bricks that were asked for are there now, or missing again if there was no room. One invocation per build.
#include "shared/passes/identity.h"
#include "tracing/identity/brick_build.glsl"
#include "tracing/identity/brick_work.glsl"
#include "tracing/identity/bricks.glsl"

layout(local_size_x = 64) in;

void main() {
  uint build = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (build < brickWork.buildCount) bricks[builds[build].brick] = builds[build].run;
}
