// Bindings and the structure of voxels alone: tracing/voxels/.
#ifndef HALFSILVER_PASSES_VOXELS_H
#define HALFSILVER_PASSES_VOXELS_H

#define SSBO_SETTLED 8          // VoxelSurface[voxels], where it is made
#define SSBO_VOXEL_SURFACES 12  // the same, where it is read

// What an occupied voxel knows of its surfaces, beside the lowest of its triangles (SSBO_VOXEL_TRIANGLES).
struct VoxelSurface {
  uint normal;  // average, see packUnit()
  uint color;   // unorm bytes: square roots of base color and reflectivity, of that triangle
};

#endif
