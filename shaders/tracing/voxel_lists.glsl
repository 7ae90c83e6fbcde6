// Lists of the identity method: one for each occupied voxel, numbered in the order of the grid. A list holds the
// fragments of all three A-buffers, whose texels and depths are the voxels', side by side: each triangle's in the axis
// that the voxel pass gave it.
layout(std430, binding = SSBO_RANKS) readonly buffer RankBlock { uint ranks[]; };  // a word: lists before its voxels
layout(std430, binding = SSBO_HEADS) coherent buffer HeadBlock { uvec2 heads[]; };  // entries from x to before y

// Of an occupied voxel.
uint listOf(ivec3 voxel) {
  uint index = voxelIndex(voxel);
  uint before = (1u << (VOXEL_BITS * (index % VOXELS_PER_WORD))) - 1u;
  uint word = index / VOXELS_PER_WORD;
  return ranks[word] + uint(bitCount(occupiedVoxels(voxelWords[word]) & before));
}
