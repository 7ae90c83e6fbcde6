// From sums of normals to one dominant axis per voxel. One invocation per word of eight voxels.
#include "shared/passes/voxelize.h"
#include "shared/tracing.h"
#include "tracing/common/grid.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = SSBO_VOXELS) buffer VoxelBlock { uint voxelWords[]; };
layout(std430, binding = SSBO_NORMAL_X) readonly buffer NormalX { int normalX[]; };
layout(std430, binding = SSBO_NORMAL_Y) readonly buffer NormalY { int normalY[]; };
layout(std430, binding = SSBO_NORMAL_Z) readonly buffer NormalZ { int normalZ[]; };
uniform uint wordCount;

void main() {
  uint word = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (word >= wordCount) return;
  uint occupied = voxelWords[word];
  if (occupied == 0u) return;
  uint result = 0u;
  for (uint i = 0u; i < VOXELS_PER_WORD; ++i) {
    if (((occupied >> (VOXEL_BITS * i)) & 7u) == 0u) continue;
    uint voxel = word * VOXELS_PER_WORD + i;
    int axis = dominantAxis(vec3(normalX[voxel], normalY[voxel], normalZ[voxel]));
    result |= (1u << uint(axis)) << (VOXEL_BITS * i);
  }
  voxelWords[word] = result;
}
