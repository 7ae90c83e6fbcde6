// Rasterizes the scene for the voxel grid.
#include "tracing/common/triangle_raster.glsl"

layout(location = 0) flat out uint outTriangle;
layout(location = 1) flat out int outAxis;
layout(location = 2) out float outDepth;

void main() {
#ifdef CONSERVATIVE
  uint triangle = uint(gl_VertexID) / 6u;
  ProjectedTriangle projected = projectTriangle(triangle, gl_InstanceID);
  gl_Position = coveringCorner(projected, gl_VertexID % 6);
  outDepth = 0.0;
#else
  uint triangle = uint(gl_VertexID) / 3u;
  ProjectedTriangle projected = projectTriangle(triangle, gl_InstanceID);
  int corner = gl_VertexID % 3;
  vec3 p = corner == 0 ? projected.a : (corner == 1 ? projected.b : projected.c);
  gl_Position = vec4(p.xy * 2.0 - 1.0, 0.0, 1.0);
  outDepth = p.z;
#endif
  outTriangle = triangle;
  outAxis = projected.axis;
}
