// Marks voxels as occupied.
#define VOXEL_ACCESS coherent
#include "tracing/common/voxel_store.glsl"

void markVoxel(ivec3 voxel, uint mask) {
  uint index = voxelIndex(voxel);
  uint shifted = mask << (VOXEL_BITS * (index % VOXELS_PER_WORD));
  // Most fragments find their bit set already; reading first saves the atomic.
  if ((voxelWords[index / VOXELS_PER_WORD] & shifted) != shifted)
    atomicOr(voxelWords[index / VOXELS_PER_WORD], shifted);
}
