// Gives the entries of new runs their boxes. Then the bricks that were asked for are there, or missing again if there was
// no room. One group per build.
#define RUN_ACCESS
#include "shared/passes/identity.h"
#include "tracing/identity/brick_requests.glsl"
#include "tracing/identity/brick_work.glsl"
#include "tracing/identity/entry_boxes.glsl"

layout(local_size_x = 64) in;

void main() {
  uint build = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (build >= brickWork.buildCount) return;
  uint run = requests[build].run, brick = requests[build].brick;
  if (gl_LocalInvocationIndex == 0u) bricks[brick] = run;
  if (run == BRICK_MISSING) return;
  uint end = run + runWords(run);
  for (uint i = run + headerWords(run) + gl_LocalInvocationIndex; i < end; i += gl_WorkGroupSize.x)
    makeBox(i, brickAt(brick));
}
