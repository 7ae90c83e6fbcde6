// Exclusive prefix sums over many items, in three dispatches (Blelloch 1990): sums of blocks (STEP 0), prefix sums of
// those (STEP 1, one group), then the items' own (STEP 2). The program that includes this file defines
// what is summed and what becomes of it.
#include "shared/passes/identity.h"

layout(local_size_x = SUM_GROUP) in;
layout(std430, binding = SSBO_BLOCK_SUMS) buffer BlockSumBlock { uint blockSums[]; };
uniform uint itemCount;
uniform uint blockCount;

uint valueOf(uint item);
void store(uint item, uint sum);  // the sum of the items before it

shared uint partial[SUM_GROUP];

// Inclusive sums of the group's values.
uint groupSum(uint value) {
  uint lane = gl_LocalInvocationIndex;
  partial[lane] = value;
  barrier();
  for (uint reach = 1u; reach < SUM_GROUP; reach *= 2u) {
    uint other = lane >= reach ? partial[lane - reach] : 0u;
    barrier();
    partial[lane] += other;
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
    carry += partial[SUM_GROUP - 1];
    barrier();
  }
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
