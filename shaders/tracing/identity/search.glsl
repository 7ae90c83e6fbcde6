// Search of the identity method: every triangle of the voxels that the ray crosses is tested exactly, but for those
// whose part in the voxel the ray passes by; the nearest hit wins, equal distances go to the lower number, so the order
// of a list has no say.
//
// Bricks are built on demand: a ray that comes to one that is missing waits for the next dispatch, see request.comp.
//
// The inner loop takes a ray at most one cube of voxels further, looks at a few entries and tests at most one triangle in
// floats. A lane whose candidate may be a hit, that has done its work or that has come to a missing brick leaves it, and
// is dealt with behind it: software rasterizers skip nothing else than what stands behind a loop that has ended.
#define BRICK_ACCESS readonly
#include "shared/passes/identity.h"
#include "shared/rays.h"
#include "tracing/common/ray_work.glsl"
#include "tracing/common/test_candidate.glsl"
#include "tracing/common/trace_state.glsl"
#include "tracing/common/walk.glsl"
#include "tracing/identity/bricks.glsl"
#include "tracing/identity/entry.glsl"
#include "tracing/identity/voxel_walk.glsl"

// Triangles that reach beyond the grid; every ray tests them.
layout(std430, binding = SSBO_OUTER) readonly buffer OuterBlock {
  uint outerCount;
  uint outer[];
};

// Looks at the next entry of a list, unless a triangle is ready to be tested.
void sift(TraceRay ray, uvec2 boxes, bool going, inout uvec2 list, inout uint ready) {
  if (!going || list.x == list.y || ready != NO_TRIANGLE) return;
  uint entry = runs[list.x++];
  if (boxMeets(entry, boxes) && triangleOf(entry) != ray.excluded) ready = triangleOf(entry);
}

// False if the ray is not through; `pause` then says how to go on.
bool march(TraceRay ray, float end, inout PausedRay pause, inout Hit best) {
  VoxelRay v = makeVoxelRay(ray);
  uint octant = octantOf(v);
  float t = pause.t, exit = t;  // where the ray enters and leaves the cube
  uint tested = pause.tested;
  ivec3 voxel = resumedVoxel(v, pause);
  Cube cube = Cube(voxel, 1, vec3(0.0));  // the voxel, or a larger cube if that is empty
  uvec2 list = uvec2(0u);                 // what is left of the voxel's entries
  uint first = 0u;                        // where they begin
  uvec2 boxes = uvec2(0u);                // that the halves of the ray's way through the voxel lie in
  uint outerLeft = outerCount;
  uint candidate = pause.bestTriangle - 1u;  // that may be a hit
  int work = 0;
  bool going = t <= end;
  bool entered = false, missing = false;
  while ((going && work < workLimit) || outerLeft > 0u || candidate != NO_TRIANGLE) {
    if (candidate == NO_TRIANGLE && outerLeft > 0u) candidate = outer[--outerLeft];
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
          missing = !present(run) && !emptyBrick(run);
          list = uvec2(0u);
          int side = 1;
          if (present(run)) list = listOf(run, voxel, side);
          if (emptyBrick(run))
            cube = emptyCube(v, octant, voxel, run);
          else
            cube = makeCube(v, voxel & ~(side - 1), side);
          exit = max(t, min(exitOf(cube), end));
          boxes = boxesOf(v, cube.low, t, exit);
          first = list.x;
          list.x += tested;
          tested = 0u;
          going = !missing;
        }
      }
      uint ready = NO_TRIANGLE;
      // Most entries are passed by.
      sift(ray, boxes, going, list, ready);
      sift(ray, boxes, going, list, ready);
      sift(ray, boxes, going, list, ready);
      sift(ray, boxes, going, list, ready);
      if (ready != NO_TRIANGLE) {
        countTest();
        if (mayHit(ray, ready, best.t)) candidate = ready;
      }
      ++work;
    }
    if (candidate != NO_TRIANGLE) testCandidate(ray, candidate, best);
    candidate = NO_TRIANGLE;
  }
  // A loop that the driver has cut may leave the last entry without its exact test.
  tested = going ? list.x - first - (candidate != NO_TRIANGLE ? 1u : 0u) : 0u;
  pause = PausedRay(t, best.t < farAway ? best.triangle + 1u : 0u, tested, packVoxel(voxel));
  return !going && !missing && outerLeft == 0u && candidate == NO_TRIANGLE;
}

void storeSurface(uint index, Hit hit) {}
