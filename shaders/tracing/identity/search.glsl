// Search of the identity method: every triangle of the voxels that the ray crosses is tested exactly; the nearest hit
// wins, equal distances go to the lower number, so the order of a list has no say.
//
// Bricks are built on demand. A ray that comes to a brick that is missing requests it, and the next few on its way, and
// waits for the next dispatch.
#include "lib/when.glsl"
#include "shared/passes/identity.h"
#include "shared/rays.h"
#include "tracing/common/test_candidate.glsl"
#include "tracing/common/trace_state.glsl"
#include "tracing/common/walk.glsl"
#include "tracing/identity/brick_work.glsl"
#include "tracing/identity/bricks.glsl"

// Triangles that reach beyond the grid; every ray tests them.
layout(std430, binding = SSBO_OUTER) readonly buffer OuterBlock {
  uint outerCount;
  uint outer[];
};
uniform uint maxRequests;  // in one dispatch
uniform int lookAhead;      // bricks with triangles that a waiting ray requests

void requestBrick(uint brick) {
  if (atomicCompSwap(bricks[brick], BRICK_MISSING, BRICK_CLAIMED) != BRICK_MISSING) return;
  uint number = atomicAdd(brickWork.requestedBricks, 1u);
  bricks[brick] = number < maxRequests ? BRICK_REQUESTED + number : BRICK_MISSING;
}

void requestAhead(TraceRay ray, ivec3 voxel, float end) {
  int left = lookAhead;
  bool going = true;
  while (going) {
    uint brick = brickIndex(brickOf(voxel)), state = bricks[brick];
    if (state != BRICK_EMPTY) --left;
    when (state == BRICK_MISSING) requestBrick(brick);
    Cell cell = cellAround(ray, voxel, BRICK_SIDE);
    going = left > 0 && cellExit(cell) < end && leaveCell(ray, cell, voxel);
  }
}

// False if the ray is not through; `pause` then says how to go on.
bool march(TraceRay ray, float end, inout PausedRay pause, inout Hit best) {
  int work = 0;
  uint done = pause.tested;
  float t = pause.t;
  for (uint i = 0u; i < outerCount; ++i) testCandidate(ray, outer[i], best);
  end = min(end, best.t);
  if (pause.bestTriangle > 0u) testCandidate(ray, pause.bestTriangle - 1u, best);
  bool yielded = false;
  uvec2 list = uvec2(0u);  // what is left of the voxel's candidates
  uint first = 0u;         // where they begin
  ivec3 voxel = voxelAt(ray, t);
  Cell cell = Cell(voxel, 1, vec3(0.0));  // the voxel, or the whole brick if that is empty
  float exit = t;
  bool going = t <= end || done > 0u, entered = false;  // a voxel that was begun is done to its end
  while (going) {
    // On to the next candidate. Walking and testing take turns, so that rays beside each other stay busy.
    while (going && list.x == list.y) {
      if (entered) {
        // A hit behind this voxel may still be beaten by a triangle of the voxels before it.
        going = best.t > exit && exit < end && leaveCell(ray, cell, voxel);
        if (going) {
          pause.bestTriangle = 0u;
          pause.tested = 0u;
          t = exit;
          when (++work >= workLimit) yielded = voxelAt(ray, t) == voxel;  // or the next one's stretch is too short, too
          going = !yielded;
        }
      }
      entered = true;
      if (going) {
        uint run = bricks[brickIndex(brickOf(voxel))];
        cell = cellAround(ray, voxel, run == BRICK_EMPTY ? BRICK_SIDE : 1);
        exit = max(t, min(cellExit(cell), end));
        if (present(run)) {
          list = listOf(run, voxel);
          first = list.x;
          list.x += done;
          done = 0u;
        }
        when (!present(run) && run != BRICK_EMPTY) {
          if (lastDispatch == 0) requestAhead(ray, voxel, end);
          yielded = true;
          going = false;
        }
      }
    }
    if (going && list.x != list.y) {
      testCandidate(ray, runs[list.x], best);
      ++list.x;
      when (++work >= workLimit && list.x != list.y) {
        // From the middle of the voxel's stretch the walk starts in this voxel again, but for the shortest ones: there
        // is no telling where rounding puts them.
        float middle = 0.5 * (t + exit);
        if (voxelAt(ray, middle) == voxel) {
          t = middle;
          pause.bestTriangle = best.t < farAway ? best.triangle + 1u : 0u;
          pause.tested = list.x - first;
          yielded = true;
          going = false;
        } else {
          list.x = list.y;  // too short a stretch to come back to; its neighbors' lists reach over it
        }
      }
    }
  }
  pause.t = t;
  return !(yielded || going);
}

void storeSurface(uint index, Hit hit) {}
