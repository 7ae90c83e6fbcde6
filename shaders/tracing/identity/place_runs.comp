// Places the run of each build behind the runs that are there, with its header, or gives the build up if there is no
// room. One invocation per build. The order of runs is that of the invocations: no list depends on it.
#define RUN_ACCESS
#include "shared/passes/identity.h"
#include "tracing/identity/brick_build.glsl"
#include "tracing/identity/brick_work.glsl"
#include "tracing/identity/bricks.glsl"

layout(local_size_x = 64) in;

// The place, or BRICK_MISSING. Whoever finds no room leaves `nextWord` behind the pool's end, so nobody after it finds
// any, and runs have no gaps between them.
uint reserve(uint words) {
  uint capacity = uint(runs.length()), run = capacity;
  // All runs of the build or none: some of them would be others each time.
  bool room = brickWork.firstWord + brickWork.buildWords <= capacity;
  if (room && brickWork.nextWord < capacity) run = atomicAdd(brickWork.nextWord, words);
  if (run < capacity && words <= capacity - run) {
    atomicMax(brickWork.usedWords, run + words);
    return run;
  }
  atomicAdd(brickWork.waitingWords, min(words, MAX_WAITING_WORDS));
  atomicMax(brickWork.longestWaiting, words);
  return BRICK_MISSING;
}

void main() {
  uint build = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (build >= brickWork.buildCount) return;
  uvec2 sum = listsAndEntries(build);
  uint lists = sum.x, words = wordsOf(sum), run = reserve(words);
  requests[build].run = run;
  if (run == BRICK_MISSING) {
    bricks[requests[build].brick] = BRICK_MISSING;  // nothing is to be stored
    return;
  }
  uvec2 occupied = uvec2(0u);
  uint ends = run + 2u, list = 0u, end = 0u;
  for (uint i = 0u; i < VOXELS_PER_BRICK; ++i) {
    uint count = builds[build].next[i];
    if (count == 0u) continue;
    occupied[i >> 5] |= 1u << (i & 31u);
    builds[build].next[i] = ends + lists + end;
    end += count;
    runs[ends + list++] = end;
  }
  runs[run] = occupied.x;
  runs[run + 1u] = occupied.y;
  atomicAdd(brickWork.headerWords, 2u + lists);
  atomicMax(brickWork.longestRun, words);
}
