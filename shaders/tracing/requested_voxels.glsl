// Voxels whose lists are to be built next: a bit each.
layout(std430, binding = SSBO_REQUESTED) REQUEST_ACCESS buffer RequestBlock { uint requestedWords[]; };

bool requested(ivec3 voxel) {
  uint index = voxelIndex(voxel);
  return (requestedWords[index >> 5] & (1u << (index & 31u))) != 0u;
}
