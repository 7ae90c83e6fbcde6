// Nothing is counted yet for the bricks that rays wait for. One group per build, one invocation per voxel.
#include "shared/passes/identity.h"
#include "tracing/identity/brick_build.glsl"
#include "tracing/identity/brick_work.glsl"

layout(local_size_x = VOXELS_PER_BRICK) in;

void main() {
  uint build = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (build < brickWork.buildCount) builds[build].next[gl_LocalInvocationIndex] = 0u;
}
