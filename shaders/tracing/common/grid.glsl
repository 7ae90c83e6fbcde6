// The grid's space: the scene's padded bounds are the unit cube. An axis `a` has its A-buffer spanned by the other
// two axes in cyclic order, (a + 1) % 3 and (a + 2) % 3, with depth along a.
uniform vec3 gridLow;         // world
uniform vec3 gridInverse;     // 1 / extent
uniform ivec3 voxelCount;     // along each axis
uniform int bufferResolution;  // texels along each axis, if the A-buffers have a raster of their own

vec3 toGrid(vec3 position) {
  precise vec3 place = (position - gridLow) * gridInverse;
  return place;
}

// Cyclic permutation that puts axis a last: (b, c, a).
vec3 permute(vec3 v, int axis) { return axis == 0 ? v.yzx : (axis == 1 ? v.zxy : v.xyz); }
// Its inverse.
vec3 unpermute(vec3 v, int axis) { return axis == 0 ? v.zxy : (axis == 1 ? v.yzx : v.xyz); }

// Voxels along the axes of an A-buffer, its depth last.
ivec3 permutedVoxels(int axis) { return ivec3(permute(vec3(voxelCount), axis)); }

// The column of voxels that holds the center of a texel, of a raster with `resolution` texels along each side.
ivec2 columnOf(ivec2 texel, ivec2 voxels, int resolution) { return (2 * texel + 1) * voxels / (2 * resolution); }

// Dominant axis of a direction; ties go to the lower axis on every device.
int dominantAxis(vec3 direction) {
  vec3 size = abs(direction);
  return size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
}

uint voxelIndex(ivec3 voxel) {
  return uint(voxel.x) + uint(voxelCount.x) * (uint(voxel.y) + uint(voxelCount.y) * uint(voxel.z));
}

uint headIndex(int axis, ivec2 texel) {
  return (uint(axis) * uint(bufferResolution) + uint(texel.y)) * uint(bufferResolution) + uint(texel.x);
}
