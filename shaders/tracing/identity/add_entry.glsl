// Entries of the lists of requested bricks: counted, then stored. Both steps are one program of exact arithmetic, so that
// they see the same voxels. Should they not, an entry that was not counted is dropped: it would be in another list's
// place, or in another run's.
#define RUN_ACCESS
#include "shared/passes/identity.h"
#ifndef BUILD_STEP
#define BUILD_STEP UBO_BUILD_STEP
#endif
#include "shared/tracing.h"
#include "tracing/common/counters.glsl"
#include "tracing/common/projections.glsl"
#include "tracing/common/voxel_store.glsl"
#include "tracing/identity/brick_build.glsl"
#include "tracing/identity/bricks.glsl"
#include "tracing/identity/entry.glsl"

uint voxelsVisited = 0u, entriesAdded = 0u;  // by this invocation

// Of a triangle, seen along `axis`, in the list of a voxel that it touches.
void addEntry(ivec3 voxel, uint triangle, int axis) {
  ++voxelsVisited;
  uint brick = brickIndex(brickOf(voxel)), state = bricks[brick];
  // In the A-buffer of the brick's axis only. With own axes that is the axis in which the triangle is drawn.
  bool inPlace = ownAxis == 1 || (voxelMaskAt(brick) & (1u << uint(axis))) != 0u;
  if (!inPlace || !requested(state)) return;
  uint build = state - BRICK_REQUESTED, place = atomicAdd(builds[build].next[voxelInBrick(voxel)], 1u);
  if (secondStep == 1) {
    int side;
    if (place >= listOf(requests[build].run, voxel, side).y) {
      countAt(COUNTER_LOST, voxel.xy);
      return;
    }
    // The box comes later: few of the voxels visited have a list to be filled.
    runs[place] = packVoxelEntry(triangle, voxelInBrick(voxel));
  }
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
