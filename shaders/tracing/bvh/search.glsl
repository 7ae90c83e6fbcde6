// Search of the bvh method: a walk through a hierarchy of boxes, nearest child first, with a stack of what is left
// behind. The yardstick for the other methods: the same rays, the same exact test.
#include "shared/rays.h"
#include "tracing/bvh/node.glsl"
#include "tracing/common/ray_work.glsl"
#include "tracing/common/test_candidate.glsl"
#include "tracing/common/trace_state.glsl"
#include "tracing/common/walk.glsl"

uint stackWords[BVH_STACK];
float stackNear[BVH_STACK];
int stackSize = 0;

bool isLeaf(uint word) { return (word & BVH_LEAF) != 0u; }  // also BVH_NO_CHILD

void push(uint word, float near, float nearest) {
  bool wanted = word != BVH_NO_CHILD && near <= nearest;
  stackWords[stackSize] = word;
  stackNear[stackSize] = near;
  stackSize += wanted ? 1 : 0;
}

// What a ray had left behind when it paused before node `number`: at each level the children behind the one it took.
// Levels come from the deepest up, so the stack is filled from its end and moved to its place.
void restoreStack(BoxRay ray, uint number, float nearest) {
  int low = BVH_STACK;
  uint child = number;
  bool climbing = child != 0u;
  while (climbing) {
    uint parent = bvhNodes[child].parent;
    Children c = childrenOf(ray, parent);
    int taken = 0;
    for (int i = 0; i < BVH_WIDTH; ++i) taken = c.words[i] == child ? i : taken;
    for (int i = 0; i < BVH_WIDTH; ++i) {
      if (i <= taken || c.words[i] == BVH_NO_CHILD || c.near[i] > nearest) continue;
      --low;
      stackWords[low] = c.words[i];
      stackNear[low] = c.near[i];
    }
    child = parent;
    climbing = child != 0u;
  }
  for (int i = low; i < BVH_STACK; ++i) {
    stackWords[i - low] = stackWords[i];
    stackNear[i - low] = stackNear[i];
  }
  stackSize = BVH_STACK - low;
}

// False if the ray is not through; `pause` then says how to go on.
//
// Each turn of the inner loop visits at most one node and tests one triangle in floats; a lane whose candidate may be a
// hit, or that has done its work, leaves it and is dealt with behind it (see tracing/README.md).
bool march(TraceRay ray, float end, inout PausedRay pause, inout Hit best) {
  if (pause.bestTriangle > 0u) testCandidate(ray, pause.bestTriangle - 1u, best);
  BoxRay boxes = makeBoxRay(ray, ray.least, end);
  uint current = pause.tested;  // node to visit, leaf to test or nothing
  if (current != 0u) restoreStack(boxes, current, best.t);
  uint leaf = 0u, leafEnd = 0u;   // what is left of a leaf
  uint candidate = NO_TRIANGLE;  // that may be a hit
  int work = 0;
  bool going = true, yielded = false;
  while (going) {
    while (going && candidate == NO_TRIANGLE && work < workLimit) {
      if (leaf == leafEnd && !isLeaf(current)) {
        countStep();
        Children c = childrenOf(boxes, current);
        push(c.words.w, c.near.w, best.t);
        push(c.words.z, c.near.z, best.t);
        push(c.words.y, c.near.y, best.t);
        current = c.near.x <= best.t ? c.words.x : BVH_NO_CHILD;
      }
      if (leaf == leafEnd && current == BVH_NO_CHILD) {
        going = stackSize > 0;
        stackSize = max(stackSize - 1, 0);
        current = going && stackNear[stackSize] <= best.t ? stackWords[stackSize] : BVH_NO_CHILD;
      }
      if (leaf == leafEnd && current != BVH_NO_CHILD && isLeaf(current)) {
        leaf = current & BVH_LEAF_FIRST;
        leafEnd = leaf + ((current & ~BVH_LEAF) >> BVH_LEAF_SHIFT) + 1u;
        current = BVH_NO_CHILD;
      }
      if (leaf != leafEnd) {
        uint triangle = bvhTriangles[leaf];
        countTest();
        if (mayHit(ray, triangle, best.t)) candidate = triangle;
        ++leaf;
      }
      ++work;
    }
    if (candidate != NO_TRIANGLE) testCandidate(ray, candidate, best);
    candidate = NO_TRIANGLE;
    if (going && work >= workLimit) {
      // Only where a node comes next can the way be found again.
      yielded = leaf == leafEnd && !isLeaf(current);
      going = !yielded;
      --work;
    }
  }
  pause = PausedRay(pause.t, best.t < farAway ? best.triangle + 1u : 0u, current, 0u);
  return !yielded;
}

void storeSurface(uint index, Hit hit) {}
