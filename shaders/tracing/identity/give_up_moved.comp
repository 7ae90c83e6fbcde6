// Bricks that triangles of the last move came to are given up, before the next move marks its own. One invocation per
// word of the packed grid.
#define VOXEL_ACCESS coherent
#include "shared/passes/identity.h"
#include "shared/tracing.h"
#include "tracing/common/voxel_store.glsl"
#include "tracing/identity/give_up.glsl"

layout(local_size_x = 64) in;
uniform uint wordCount;
const uint movedBits = 0x11111111u * VOXEL_MOVED;

void main() {
  uint word = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (word >= wordCount) return;
  uint voxels = voxelWords[word], left = voxels & movedBits;
  if (left != 0u) voxelWords[word] = voxels & ~movedBits;
  while (left != 0u) {
    giveUp(word * VOXELS_PER_WORD + uint(findLSB(left)) / VOXEL_BITS);
    left &= left - 1u;
  }
}
