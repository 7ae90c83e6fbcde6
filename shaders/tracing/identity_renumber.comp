// Carries heads over to new numbers after voxels have become occupied. One invocation a word of the grid.
#include "shared/bindings.h"
#include "shared/structs.h"
#include "tracing/grid.glsl"
#define VOXEL_ACCESS readonly
#include "tracing/voxel_store.glsl"
#include "tracing/voxel_lists.glsl"

layout(local_size_x = 64) in;
// As they were before.
layout(std430, binding = SSBO_OLD_VOXELS) readonly buffer OldVoxelBlock { uint oldWords[]; };
layout(std430, binding = SSBO_OLD_RANKS) readonly buffer OldRankBlock { uint oldRanks[]; };
layout(std430, binding = SSBO_OLD_HEADS) readonly buffer OldHeadBlock { uvec2 oldHeads[]; };
uniform uint wordCount;

void main() {
  uint word = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (word >= wordCount) return;
  uint before = occupiedVoxels(oldWords[word]);
  uint list = ranks[word], oldList = oldRanks[word];
  for (uint left = occupiedVoxels(voxelWords[word]); left != 0u; left &= left - 1u) {
    bool known = (before & left & -left) != 0u;
    heads[list] = known ? oldHeads[oldList] : uvec2(LIST_MISSING);
    ++list;
    if (known) ++oldList;
  }
}
