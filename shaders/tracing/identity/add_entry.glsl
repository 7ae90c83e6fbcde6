// Entries of the lists of requested bricks: counted, then stored. Both steps are one program, so that they see the same
// voxels whatever the compiler makes of the arithmetic.
#define RUN_ACCESS
#include "shared/passes/identity.h"
#include "shared/tracing.h"
#include "tracing/common/counters.glsl"
#include "tracing/common/projections.glsl"
#include "tracing/common/voxel_store.glsl"
#include "tracing/identity/brick_build.glsl"
#include "tracing/identity/bricks.glsl"
#include "tracing/identity/entry.glsl"

uniform int secondStep;

uint voxelsVisited = 0u, entriesAdded = 0u;  // by this invocation

// Of a triangle, seen along `axis`, in the list of a voxel that it touches.
void addEntry(ivec3 voxel, uint triangle, int axis) {
  ++voxelsVisited;
  uint brick = brickIndex(brickOf(voxel)), state = bricks[brick];
  // In the A-buffer of the brick's axis only. With own axes that is the axis in which the triangle is drawn.
  bool inPlace = ownAxis == 1 || (voxelMaskAt(brick) & (1u << uint(axis))) != 0u;
  if (!inPlace || !requested(state)) return;
  uint place = atomicAdd(builds[state - BRICK_REQUESTED].next[voxelInBrick(voxel)], 1u);
  // The box comes later, for which the voxel holds the place: few of the voxels visited have a list to be filled.
  if (secondStep == 1) runs[place] = packEntry(triangle, boxSlices > 0 ? voxelInBrick(voxel) : 0u);
  ++entriesAdded;
}

// Adds what the invocation has done to the counters, in the slot of a texel.
void countEntries(int axis, ivec2 texel) {
  if (secondStep == 0)
    countAt(COUNTER_FRAGMENTS, texel, voxelsVisited);
  else
    countAt(COUNTER_STORED_X + uint(axis), texel, entriesAdded);
  voxelsVisited = entriesAdded = 0u;
}
