// The packed voxel grid (see shared/tracing.h). Programs that write it define VOXEL_ACCESS before anything else.
#include "shared/passes/voxelize.h"
#include "shared/tracing.h"
#include "tracing/common/grid.glsl"

#ifndef VOXEL_ACCESS
#define VOXEL_ACCESS readonly
#endif
layout(std430, binding = SSBO_VOXELS) VOXEL_ACCESS buffer VoxelBlock { uint voxelWords[]; };

uint voxelMaskAt(uint index) {
  return (voxelWords[index / VOXELS_PER_WORD] >> (VOXEL_BITS * (index % VOXELS_PER_WORD))) & 7u;
}

uint voxelMask(ivec3 voxel) { return voxelMaskAt(voxelIndex(voxel)); }
