// Sums up the words of each requested brick's run; places it behind the runs that are there, with its header.
#define RUN_ACCESS
#include "shared/passes/identity.h"
#include "tracing/identity/brick_build.glsl"
#include "tracing/identity/brick_work.glsl"
#include "tracing/identity/bricks.glsl"
#include "tracing/identity/prefix_sum.glsl"

uniform uint firstWord;
const uint voxelsOfBrick = BRICK_SIDE * BRICK_SIDE * BRICK_SIDE;

uint valueOf(uint item) {
  uint state = bricks[item];
  if (!requested(state)) return 0u;
  uint words = 2u;
  for (uint i = 0u; i < voxelsOfBrick; ++i) {
    uint count = builds[state - BRICK_REQUESTED].next[i];
    words += count > 0u ? count + 1u : 0u;
  }
  if (words > brickWork.longestRun) atomicMax(brickWork.longestRun, words);
  return words;
}

void store(uint item, uint sum) {
  uint state = bricks[item];
  if (!requested(state)) return;
  uint build = state - BRICK_REQUESTED, run = firstWord + sum;
  uvec2 occupied = uvec2(0u);
  uint ends = run + 2u, list = 0u, end = 0u;
  for (uint i = 0u; i < voxelsOfBrick; ++i) {
    uint count = builds[build].next[i];
    if (count == 0u) continue;
    occupied[i >> 5] |= 1u << (i & 31u);
    builds[build].next[i] = end;
    end += count;
    runs[ends + list++] = end;
  }
  runs[run] = occupied.x;
  runs[run + 1u] = occupied.y;
  builds[build].run = run;
  for (uint i = 0u; i < voxelsOfBrick; ++i) builds[build].next[i] += ends + list;
  atomicAdd(brickWork.headerWords, 2u + list);
}
