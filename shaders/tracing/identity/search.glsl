// Search of the identity method: every triangle of the voxels that the ray crosses is tested exactly; the nearest hit
// wins, equal distances go to the lower number, so the order of a list has no say.
//
// Bricks are built on demand. A ray that comes to a brick that is missing requests it, and the next few on its way, and
// waits for the next dispatch.
#include "shared/passes/identity.h"
#include "shared/rays.h"
#include "tracing/common/ray_work.glsl"
#include "tracing/common/test_candidate.glsl"
#include "tracing/common/trace_state.glsl"
#include "tracing/common/walk.glsl"
#include "tracing/identity/brick_work.glsl"
#include "tracing/identity/bricks.glsl"
#include "tracing/identity/voxel_walk.glsl"

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

// The brick that a ray waits for, and the next ones on its way.
void requestAhead(VoxelRay v, ivec3 voxel, float end) {
  int left = lookAhead;
  bool going = true;
  while (going) {
    uint brick = brickIndex(brickOf(voxel)), state = bricks[brick];
    if (state != BRICK_EMPTY) --left;
    if (state == BRICK_MISSING) requestBrick(brick);
    Cube cube = brickCube(v, voxel);
    voxel = voxelBehind(v, cube);
    going = left > 0 && exitOf(cube) < end && inGrid(voxel);
  }
}

// False if the ray is not through; `pause` then says how to go on.
//
// The inner loop walks and tests in floats; a lane whose candidate may be a hit, that has done its work or that has come
// to a missing brick leaves it, and is dealt with behind it. Software rasterizers skip nothing else than what stands
// behind a loop that has ended.
bool march(TraceRay ray, float end, inout PausedRay pause, inout Hit best) {
  for (uint i = 0u; i < outerCount; ++i) testCandidate(ray, outer[i], best);
  end = min(end, best.t);
  if (pause.bestTriangle > 0u) testCandidate(ray, pause.bestTriangle - 1u, best);

  VoxelRay v = makeVoxelRay(ray);
  float t = pause.t, exit = t;
  uint tested = pause.tested;
  ivec3 voxel = clamp(voxelAt(v, t), ivec3(0), voxelCount - 1);
  Cube cube = Cube(voxel, 1, vec3(0.0));  // the voxel, or the whole brick if that is empty
  uvec2 list = uvec2(0u);                 // what is left of the voxel's candidates
  uint first = 0u;                        // where they begin
  uint candidate = NO_TRIANGLE;           // that may be a hit
  int work = 0;
  bool going = t <= end || tested > 0u;  // a voxel that was begun is done to its end
  bool entered = false, missing = false, yielded = false;
  while (going) {
    while (going && candidate == NO_TRIANGLE && work < workLimit) {
      if (list.x == list.y) {
        if (entered) {
          // A hit behind this voxel may still be beaten by a triangle of the voxels before it.
          going = best.t > exit && exit < end;
          voxel = voxelBehind(v, cube);
          going = going && inGrid(voxel);
          t = exit;
        }
        entered = true;
        if (going) {
          countStep();
          uint run = bricks[brickIndex(brickOf(voxel))];
          if (run == BRICK_EMPTY)
            cube = brickCube(v, voxel);
          else
            cube = makeCube(v, voxel, 1);
          exit = max(t, min(exitOf(cube), end));
          list = present(run) ? listOf(run, voxel) : uvec2(0u);
          first = list.x;
          list.x += tested;
          tested = 0u;
          missing = !present(run) && run != BRICK_EMPTY;
          going = !missing;
        }
      }
      if (going && list.x != list.y) {
        uint triangle = runs[list.x];
        countTest();
        if (mayHit(ray, triangle, best.t)) candidate = triangle;
        ++list.x;
      }
      ++work;
    }
    if (candidate != NO_TRIANGLE) testCandidate(ray, candidate, best);
    candidate = NO_TRIANGLE;
    if (going && work >= workLimit) {
      // From the middle of its stretch the walk begins in this cube again, but for the shortest stretches: there is no
      // telling where rounding puts them. Those are done first.
      float middle = 0.5 * (t + exit);
      yielded = contains(cube, voxelAt(v, middle));
      if (yielded) {
        t = middle;
        tested = list.x - first;
        going = false;
      } else {
        --work;
      }
    }
  }
  if (missing && lastDispatch == 0) requestAhead(v, voxel, end);
  pause = PausedRay(t, best.t < farAway ? best.triangle + 1u : 0u, tested, 0u);
  return !(missing || yielded || going);
}

void storeSurface(uint index, Hit hit) {}
