// The packed voxel grid (see shared/tracing.h).
layout(std430, binding = SSBO_VOXELS) VOXEL_ACCESS buffer VoxelBlock { uint voxelWords[]; };

uint voxelMask(ivec3 voxel) {
  uint index = voxelIndex(voxel);
  return (voxelWords[index / VOXELS_PER_WORD] >> (VOXEL_BITS * (index % VOXELS_PER_WORD))) & 7u;
}

// Bit 0 of each voxel of the word that is occupied.
uint occupiedVoxels(uint word) { return (word | word >> 1 | word >> 2) & 0x11111111u; }

#ifdef VOXEL_WRITE
void markVoxel(ivec3 voxel, uint mask) {
  uint index = voxelIndex(voxel);
  uint shifted = mask << (VOXEL_BITS * (index % VOXELS_PER_WORD));
  // Most fragments find their bit set already; reading first spares the atomic.
  if ((voxelWords[index / VOXELS_PER_WORD] & shifted) != shifted)
    atomicOr(voxelWords[index / VOXELS_PER_WORD], shifted);
}
#endif
