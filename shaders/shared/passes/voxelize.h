// Bindings of the coarse grid's pass: tracing/common/voxelize.* and voxel_axis.comp. The methods read the grid at the
// same number.
#ifndef HALFSILVER_PASSES_VOXELIZE_H
#define HALFSILVER_PASSES_VOXELIZE_H

#define SSBO_VOXELS 11    // uint[]: VOXELS_PER_WORD voxels each
#define SSBO_NORMAL_X 12  // int[voxels]: sums of normals, times NORMAL_SCALE
#define SSBO_NORMAL_Y 13
#define SSBO_NORMAL_Z 14
#define SSBO_VOXEL_TRIANGLES 15  // uint[voxels]: the lowest triangle that has a fragment there, or NO_TRIANGLE

#endif
