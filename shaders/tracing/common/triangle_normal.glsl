// Triangle normals for choosing an axis. In units of voxels, because the A-buffers' texels are square there: the axis
// in which the projection is largest in texels is the one that samples the triangle best.
#include "tracing/common/grid.glsl"

// Not normalised: twice the area in voxels. Zero for a degenerate triangle.
vec3 gridNormal(vec3 a, vec3 b, vec3 c) {
  vec3 scale = gridInverse * vec3(voxelCount);
  return cross((b - a) * scale, (c - a) * scale);
}

vec3 unitOrZero(vec3 v) {
  float size = length(v);
  return size > 0.0 ? v / size : vec3(0.0);
}
