// The voxels that a triangle touches. The raster is the voxel grid's own, seen along the triangle's axis.
#include "tracing/common/grid.glsl"
#include "tracing/common/projections.glsl"
#include "tracing/common/small_triangle.glsl"
#include "tracing/common/texel_overlap.glsl"

// What becomes of a voxel: the program that includes this file defines it.
void visitVoxel(ivec3 voxel);

// The first and the last depth of a texel's column that the triangle touches; none if the last is before the first.
ivec2 touchedDepths(ProjectedTriangle t, ivec2 texel) {
  ivec3 voxels = permutedVoxels(t.axis);
  vec2 depths;
  bool touches = texel.x < voxels.x && texel.y < voxels.y &&
                 touchesTexel(t.a, t.b, t.c, texel, vec2(voxels.xy), depths);
  precise vec2 range = depths * float(voxels.z) + vec2(-overlapSlack, overlapSlack);
  int first = clamp(int(floor(range.x)), 0, voxels.z - 1);
  int last = touches ? clamp(int(floor(range.y)), 0, voxels.z - 1) : -1;
  return ivec2(first, last);
}

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
