// Adds up the words of all runs of a build, to know whether there is room for them. One invocation per build.
#include "shared/passes/identity.h"
#include "tracing/identity/brick_build.glsl"
#include "tracing/identity/brick_work.glsl"

layout(local_size_x = 64) in;

void main() {
  uint build = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (build >= brickWork.buildCount) return;
  atomicAdd(brickWork.buildWords, min(wordsOf(listsAndEntries(build)), MAX_WAITING_WORDS));
}
