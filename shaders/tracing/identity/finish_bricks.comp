// Gives the entries of new runs their boxes. Then the bricks that were asked for are there, or missing again if there was
// no room. One group per build.
#define RUN_ACCESS
#include "shared/passes/identity.h"
#include "tracing/identity/brick_build.glsl"
#include "tracing/identity/brick_work.glsl"
#include "tracing/identity/bricks.glsl"
#include "tracing/identity/entry.glsl"
#include "tracing/identity/triangle_part.glsl"

layout(local_size_x = 64) in;

void main() {
  uint build = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (build >= brickWork.buildCount) return;
  uint run = builds[build].run, brick = builds[build].brick;
  if (gl_LocalInvocationIndex == 0u) bricks[brick] = run;
  if (run == BRICK_MISSING || boxSlices == 0) return;
  ivec3 corner = brickAt(brick) << BRICK_SHIFT;
  uint end = run + runWords(run);
  for (uint i = run + headerWords(run) + gl_LocalInvocationIndex; i < end; i += gl_WorkGroupSize.x) {
    uint triangle = triangleOf(runs[i]);
    runs[i] = packEntry(triangle, partInVoxel(triangle, corner + voxelOfBrick(runs[i] >> boxShift)));
  }
}
