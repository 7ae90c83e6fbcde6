// The voxels that a triangle touches.
#include "tracing/common/projections.glsl"
#include "tracing/common/small_triangle.glsl"
#include "tracing/common/touched_depths.glsl"

// What becomes of a voxel: the program that includes this file defines it.
void visitVoxel(ivec3 voxel);

// Calls visitVoxel() for the voxels of a texel's column.
void visitTouchedVoxels(ProjectedTriangle t, ivec2 texel) {
  ivec2 depths = touchedDepths(t, texel);
  for (int depth = depths.x; depth <= depths.y; ++depth) visitVoxel(ivec3(unpermute(vec3(texel, depth), t.axis)));
}

// For all voxels of a small triangle's projection.
void visitSmallTriangle(ProjectedTriangle t) {
  TexelBox box = texelBox(t);
  ivec2 texel = box.low;
  for (int left = box.size.x * box.size.y; left > 0; --left) {
    visitTouchedVoxels(t, texel);
    ++texel.x;
    if (texel.x == box.low.x + box.size.x) texel = ivec2(box.low.x, texel.y + 1);
  }
}
