// Triangle normals for choosing an axis. In grid space, because the A-buffers' texels are square there: the axis in
// which the projection is largest in texels is the one that samples the triangle best.

// Not normalised: twice the area in grid units. Zero for a degenerate triangle.
vec3 gridNormal(vec3 a, vec3 b, vec3 c) { return cross((b - a) * gridInverse, (c - a) * gridInverse); }

vec3 unitOrZero(vec3 v) {
  float size = length(v);
  return size > 0.0 ? v / size : vec3(0.0);
}
