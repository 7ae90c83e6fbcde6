// Exclusive prefix sums over many items, in three dispatches (Blelloch 1990): sums of blocks (STEP 0), prefix sums of
// those and the total (STEP 1, one group), then the items' own (STEP 2). What is summed and where the results go:
// RANKS: occupied voxels of each word of the grid, into their ranks.
// LISTS: entries of each requested list, into its place behind the entries that are there.
// COMPACT: entries of each list that is there; moves them together into another buffer.
#include "shared/bindings.h"
#include "shared/structs.h"
#include "tracing/grid.glsl"
#define VOXEL_ACCESS readonly
#include "tracing/voxel_store.glsl"

layout(local_size_x = SUM_GROUP) in;
layout(std430, binding = SSBO_LINKS) buffer BlockSumBlock { uint blockSums[]; };
layout(std430, binding = SSBO_LIST_BUILD) buffer ListBuildBlock { ListBuild listBuild; };
uniform uint itemCount;
uniform uint blockCount;

#ifdef RANKS
layout(std430, binding = SSBO_RANKS) writeonly buffer RankBlock { uint ranks[]; };
uint valueOf(uint item) {
  return uint(bitCount(occupiedVoxels(voxelWords[item])));
}
void store(uint item, uint sum) { ranks[item] = sum; }
#endif
#if defined(LISTS) || defined(COMPACT)
layout(std430, binding = SSBO_HEADS) buffer HeadBlock { uvec2 heads[]; };
#endif
#ifdef LISTS
uniform uint firstEntry;
uint valueOf(uint item) {
  uint count = heads[item].x == LIST_REQUESTED ? heads[item].y : 0u;
  if (count > listBuild.longest) atomicMax(listBuild.longest, count);
  return count;
}
void store(uint item, uint sum) {
  // The end grows with every fragment that is stored.
  if (heads[item].x == LIST_REQUESTED) heads[item] = uvec2(firstEntry + sum);
}
#endif
#ifdef COMPACT
layout(std430, binding = SSBO_ENTRIES) readonly buffer EntryBlock { uint entries[]; };
layout(std430, binding = SSBO_MOVED_ENTRIES) writeonly buffer MovedBlock { uint moved[]; };
uint valueOf(uint item) { return heads[item].x < LIST_REQUESTED ? heads[item].y - heads[item].x : 0u; }
void store(uint item, uint sum) {
  uvec2 list = heads[item];
  if (list.x >= LIST_REQUESTED) return;
  for (uint i = list.x; i < list.y; ++i) moved[sum + i - list.x] = entries[i];
  heads[item] = uvec2(sum, sum + list.y - list.x);
}
#endif

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
  if (lane == 0u) listBuild.total = carry;
#else
  uint block = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (block >= blockCount) return;
  uint first = block * SUM_GROUP * SUM_ITEMS + lane * SUM_ITEMS;
  uint own = 0u;
  for (uint i = first; i < min(first + SUM_ITEMS, itemCount); ++i) own += valueOf(i);
  uint sum = groupSum(own);
#if STEP == 0
  if (lane == SUM_GROUP - 1u) blockSums[block] = sum;
#else
  uint before = blockSums[block] + sum - own;
  for (uint i = first; i < min(first + SUM_ITEMS, itemCount); ++i) {
    uint value = valueOf(i);
    store(i, before);
    before += value;
  }
#endif
#endif
}
