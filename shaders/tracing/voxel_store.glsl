// The packed voxel grid (see shared/tracing.h).
layout(std430, binding = SSBO_VOXELS) VOXEL_ACCESS buffer VoxelBlock { uint voxelWords[]; };

uint voxelMaskAt(uint index) {
  return (voxelWords[index / VOXELS_PER_WORD] >> (VOXEL_BITS * (index % VOXELS_PER_WORD))) & 7u;
}

uint voxelMask(ivec3 voxel) { return voxelMaskAt(voxelIndex(voxel)); }

#ifdef VOXEL_WRITE
void markVoxel(ivec3 voxel, uint mask) {
  uint index = voxelIndex(voxel);
  uint shifted = mask << (VOXEL_BITS * (index % VOXELS_PER_WORD));
  // Most fragments find their bit set already; reading first spares the atomic.
  if ((voxelWords[index / VOXELS_PER_WORD] & shifted) != shifted)
    atomicOr(voxelWords[index / VOXELS_PER_WORD], shifted);
}
#endif
