// Gives the entries of new runs their boxes. Then the bricks that were asked for are there, or missing again if there was
// no room. A place that no entry was stored in may hold anything: what is no triangle becomes one, which the exact test
// of the search refuses. One group per build.
#define RUN_ACCESS
#include "shared/passes/identity.h"
#include "tracing/identity/brick_build.glsl"
#include "tracing/identity/brick_work.glsl"
#include "tracing/identity/bricks.glsl"
#include "tracing/identity/entry.glsl"
#include "tracing/identity/triangle_part.glsl"

layout(local_size_x = 64) in;
uniform uint triangleCount;

void main() {
  uint build = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (build >= brickWork.buildCount) return;
  uint run = builds[build].run, brick = builds[build].brick;
  if (gl_LocalInvocationIndex == 0u) bricks[brick] = run;
  if (run == BRICK_MISSING) return;
  ivec3 corner = brickAt(brick) << BRICK_SHIFT;
  uint end = run + runWords(run);
  for (uint i = run + headerWords(run) + gl_LocalInvocationIndex; i < end; i += gl_WorkGroupSize.x) {
    uint entry = runs[i], triangle = min(triangleOf(entry), triangleCount - 1u);
    uint box = 0u;
    if (boxSlices > 0) box = partInVoxel(triangle, corner + voxelOfBrick(entry >> boxShift));
    runs[i] = packEntry(triangle, box);
  }
}
