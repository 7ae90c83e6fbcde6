// Entries get their boxes when their run is complete. A place that no entry was stored in, which only the builds by
// several steps may leave, may hold anything: what is no triangle becomes one, which the exact test of the search refuses.
#ifndef RUN_ACCESS
#define RUN_ACCESS
#endif
#include "tracing/identity/bricks.glsl"
#include "tracing/identity/entry.glsl"
#include "tracing/identity/triangle_part.glsl"

uniform uint triangleCount;

void makeBox(uint place, ivec3 brick) {
  uint entry = runs[place], triangle = min(triangleOf(entry), triangleCount - 1u);
  uint box = 0u;
  if (boxSlices > 0) box = partInVoxel(triangle, (brick << BRICK_SHIFT) + voxelOfBrick(entry >> boxShift));
  runs[place] = packEntry(triangle, box);
}
