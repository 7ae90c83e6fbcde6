// Search of the identity method: every triangle of the voxels that the ray crosses is tested exactly, but for those
// whose part in the voxel the ray passes by; the nearest hit wins, equal distances go to the lower number, so the order
// of a list has no say.
//
// Bricks are built on demand: a ray that comes to one that is missing waits for the next dispatch, see request.comp.
//
// What is done most often stands in the innermost loop. A ray that needs something rarer leaves the loop and waits
// until its neighbors need it, too, or a number of turns is over: processors that run neighboring rays in step, and
// software rasterizers above all, skip nothing else than what stands behind a loop that has ended.
#define BRICK_ACCESS readonly
#include "shared/passes/identity.h"
#include "shared/rays.h"
#include "tracing/common/ray_queue.glsl"
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

// Turns of the inner loop between two tests, and tests between two looks at what is rarer still.
#ifndef TURNS
#define TURNS 64
#endif
#ifndef SIFTS
#define SIFTS 4
#endif
// Iterations of all loops that a round takes at most.
#define ROUND_ITERATIONS (1 + TURNS * (1 + SIFTS))

struct Search {
  uint index;  // of the ray
  TraceRay ray;
  VoxelRay walk;
  uint octant;     // that the ray goes to
  float t, exit;   // where the ray enters and leaves the cube
  float end;       // where it leaves the grid or is long enough
  Cube cube;       // the voxel, or a larger one if that is empty
  bool entered;    // false before the first cube
  uvec2 list;      // what is left of the voxel's entries
  uint first;      // where they begin
  uvec2 boxes;     // that the two halves of the ray's way through the voxel lie in
  uint outerLeft;  // triangles beyond the grid that are not tested yet
  uint ready;      // a triangle to test
  uint candidate;  // one that may be a hit
  bool going, missing;
  Hit best;
};

Search beginSearch(uint index) {
  Search s;
  s.index = index;
  s.ray = loadRay(index);
  s.walk = makeVoxelRay(s.ray);
  s.octant = octantOf(s.walk);
  PausedRay pause = loadPause(index);
  vec2 range = gridRange(s.ray);
  s.t = s.exit = max(range.x, pause.t);
  s.end = min(range.y, s.ray.most);
  s.cube = Cube(clamp(voxelAt(s.walk, s.t), ivec3(0), voxelCount - 1), 1, vec3(0.0));
  s.entered = false;
  s.list = uvec2(0u);
  s.first = pause.tested;
  s.boxes = uvec2(0u);
  s.outerLeft = outerCount;
  s.ready = NO_TRIANGLE;
  s.candidate = pause.bestTriangle - 1u;
  s.going = s.t <= s.end || pause.tested > 0u;  // a voxel that was begun is done to its end
  s.missing = false;
  s.best = Hit(farAway, NO_TRIANGLE, 0.0, 0.0);
  return s;
}

// On to the next cube of voxels.
void stepOn(inout Search s) {
  ivec3 voxel = s.cube.low;
  uint tested = s.first;
  if (s.entered) {
    // A hit behind this voxel may still be beaten by a triangle of the voxels before it.
    s.going = s.best.t > s.exit && s.exit < s.end;
    voxel = voxelBehind(s.walk, s.cube);
    s.going = s.going && inGrid(voxel);
    s.t = s.exit;
    tested = 0u;
  }
  s.entered = true;
  if (!s.going) return;
  countStep();
  uint run = bricks[brickIndex(brickOf(voxel))];
  if (present(run)) {
    int side;
    s.list = listOf(run, voxel, side);
    s.cube = makeCube(s.walk, voxel & ~(side - 1), side);
  } else {
    s.cube = brickCube(s.walk, s.octant, voxel, run);
  }
  s.exit = max(s.t, min(exitOf(s.cube), s.end));
  s.first = s.list.x;
  s.list.x += tested;
  s.missing = !present(run) && !emptyBrick(run);
  s.going = !s.missing;
  float until = min(s.exit, s.best.t);
  vec3 corner = vec3(s.cube.low);
  vec3 from = s.walk.origin + s.walk.direction * s.t - corner, to = s.walk.origin + s.walk.direction * until - corner;
  vec3 middle = 0.5 * (from + to);
  s.boxes = uvec2(boxBits(min(from, middle), max(from, middle)), boxBits(min(middle, to), max(middle, to)));
}

// Looks at one entry of the list.
void sift(inout Search s) {
  uint entry = runs[s.list.x];
  ++s.list.x;
  bool meets = boxMeets(entry, s.boxes.x) || boxMeets(entry, s.boxes.y);
  if (meets && triangleOf(entry) != s.ray.excluded) s.ready = triangleOf(entry);
  if (s.ready != NO_TRIANGLE) countTest();
}

// False if the ray is not through and this voxel is one to come back to: the middle of its stretch finds it again.
void finish(inout Search s) {
  keepWork(s.index);
  bool through = !s.going && !s.missing;
  if (through || lastDispatch == 1) {
    storeHit(s.index, s.ray, s.best, through);
    return;
  }
  PausedRay pause = PausedRay(s.t, s.best.t < farAway ? s.best.triangle + 1u : 0u, 0u, 0u);
  float middle = 0.5 * (s.t + s.exit);
  if (s.going && s.entered && contains(s.cube, voxelAt(s.walk, middle))) {
    pause.t = middle;
    pause.tested = s.list.x - s.first;
  }
  pauseRay(s.index, pause);
}

// A ray that the dispatch does not come to.
void postpone(uint index) {
  if (lastDispatch == 1)
    storeHit(index, loadRay(index), Hit(farAway, NO_TRIANGLE, 0.0, 0.0), false);
  else
    pauseRay(index, loadPause(index));
}

// The next ray for this invocation; false if there is none.
bool takeRay(out uint index);

void traceRays() {
  Search s;
  bool some = true, tracing = false;
  int work = 0;
  while (some || tracing) {
    if (!tracing) {
      uint index;
      some = some && takeRay(index);
      tracing = some;
      if (some) s = beginSearch(index);
    }
    if (s.outerLeft > 0u && tracing) {
      --s.outerLeft;
      s.candidate = outer[s.outerLeft];
    }
    for (int turn = 0; turn < TURNS && tracing && s.going && s.candidate == NO_TRIANGLE; ++turn) {
      if (s.list.x == s.list.y) stepOn(s);
      s.ready = NO_TRIANGLE;
      for (int i = 0; i < SIFTS; ++i) {
        if (s.going && s.list.x != s.list.y && s.ready == NO_TRIANGLE) sift(s);
      }
      if (s.ready != NO_TRIANGLE && mayHit(s.ray, s.ready, s.best.t)) s.candidate = s.ready;
    }
    if (tracing && s.candidate != NO_TRIANGLE) testCandidate(s.ray, s.candidate, s.best);
    s.candidate = NO_TRIANGLE;
    work += ROUND_ITERATIONS;
    bool yielding = work >= workLimit;
    if (tracing && ((!s.going && s.outerLeft == 0u) || yielding)) {
      finish(s);
      tracing = false;
    }
    some = some && !yielding;
  }
}
