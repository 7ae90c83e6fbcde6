// Sums up the words of each requested brick's run; places it behind the runs that are there, with its header. Items are
// builds.
#define RUN_ACCESS
#include "shared/passes/identity.h"
#include "tracing/identity/brick_build.glsl"
#include "tracing/identity/brick_work.glsl"
#include "tracing/identity/bricks.glsl"
#include "tracing/identity/prefix_sum.glsl"

uniform uint firstWord;
const uint voxelsOfBrick = BRICK_SIDE * BRICK_SIDE * BRICK_SIDE;

uint valueOf(uint item) {
  uint words = 2u;
  for (uint i = 0u; i < voxelsOfBrick; ++i) {
    uint count = builds[item].next[i];
    words += count > 0u ? count + 1u : 0u;
  }
  if (words > brickWork.longestRun) atomicMax(brickWork.longestRun, words);
  return words;
}

void store(uint item, uint sum) {
  uint run = firstWord + sum;
  uvec2 occupied = uvec2(0u);
  uint ends = run + 2u, list = 0u, end = 0u;
  for (uint i = 0u; i < voxelsOfBrick; ++i) {
    uint count = builds[item].next[i];
    if (count == 0u) continue;
    occupied[i >> 5] |= 1u << (i & 31u);
    builds[item].next[i] = end;
    end += count;
    runs[ends + list++] = end;
  }
  runs[run] = occupied.x;
  runs[run + 1u] = occupied.y;
  builds[item].run = run;
  for (uint i = 0u; i < voxelsOfBrick; ++i) builds[item].next[i] += ends + list;
  atomicAdd(brickWork.headerWords, 2u + list);
}
