// Exclusive prefix sums over many items, in three dispatches (Blelloch 1990): sums of blocks (STEP 0), prefix sums of
// those and the total (STEP 1, one group), then the items' own (STEP 2). What is summed and where the results go:
// RUNS: words of each requested brick's run, into its place behind the runs that are there, with its header.
// COMPACT: words of each run that is there; moves them together into another buffer.
#include "shared/bindings.h"
#include "shared/structs.h"
#include "tracing/grid.glsl"
#define RUN_ACCESS
#include "tracing/bricks.glsl"

layout(local_size_x = SUM_GROUP) in;
layout(std430, binding = SSBO_LINKS) buffer BlockSumBlock { uint blockSums[]; };
layout(std430, binding = SSBO_LIST_BUILD) buffer ListBuildBlock { ListBuild listBuild; };
uniform uint itemCount;
uniform uint blockCount;

#ifdef RUNS
#include "tracing/brick_build.glsl"
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
  if (words > listBuild.longest) atomicMax(listBuild.longest, words);
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
  atomicAdd(listBuild.headers, 2u + list);
}
#endif
#ifdef COMPACT
layout(std430, binding = SSBO_MOVED_RUNS) writeonly buffer MovedBlock { uint moved[]; };

uint valueOf(uint item) { return present(bricks[item]) ? runWords(bricks[item]) : 0u; }

void store(uint item, uint sum) {
  uint run = bricks[item];
  if (!present(run)) return;
  uint words = runWords(run);
  for (uint i = 0u; i < words; ++i) moved[sum + i] = runs[run + i];
  bricks[item] = sum;
}
#endif

shared uint partial[SUM_GROUP];

// Sums that are too large for a word stay the largest one, which finds no room anywhere.
uint plus(uint a, uint b) { return a + b < a ? 0xffffffffu : a + b; }

// Inclusive sums of the group's values.
uint groupSum(uint value) {
  uint lane = gl_LocalInvocationIndex;
  partial[lane] = value;
  barrier();
  for (uint reach = 1u; reach < SUM_GROUP; reach *= 2u) {
    uint other = lane >= reach ? partial[lane - reach] : 0u;
    barrier();
    partial[lane] = plus(partial[lane], other);
    barrier();
  }
  return partial[lane];
}

void main() {
  uint lane = gl_LocalInvocationIndex;
#if STEP == 1
  uint carry = 0u;
  for (uint first = 0u; first < blockCount; first += SUM_GROUP) {
    uint value = first + lane < blockCount ? blockSums[first + lane] : 0u;
    uint sum = groupSum(value);
    if (first + lane < blockCount) blockSums[first + lane] = carry + sum - value;
    carry = plus(carry, partial[SUM_GROUP - 1]);
    barrier();
  }
  if (lane == 0u) listBuild.total = carry;
#else
  uint block = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (block >= blockCount) return;
  uint item = block * SUM_GROUP + lane;
  uint value = item < itemCount ? valueOf(item) : 0u;
  uint sum = groupSum(value);
#if STEP == 0
  if (lane == SUM_GROUP - 1u) blockSums[block] = sum;
#else
  if (item < itemCount) store(item, blockSums[block] + sum - value);
#endif
#endif
}
