// What a triangle touches of a column of voxels. The raster is the voxel grid's own, seen along the triangle's axis.
#include "tracing/common/grid.glsl"
#include "tracing/common/projections.glsl"
#include "tracing/common/texel_overlap.glsl"

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
