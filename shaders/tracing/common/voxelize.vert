// Rasterizes the scene for the voxel grid: the projected corners.
#include "tracing/common/triangle_raster.glsl"

layout(location = 0) flat out uint outTriangle;
layout(location = 1) flat out int outAxis;
layout(location = 2) out float outDepth;

void main() {
  outTriangle = uint(gl_VertexID) / 3u;
  ProjectedTriangle projected = projectTriangle(outTriangle, gl_InstanceID);
  int corner = gl_VertexID % 3;
  vec3 p = corner == 0 ? projected.a : (corner == 1 ? projected.b : projected.c);
  gl_Position = vec4(p.xy * 2.0 - 1.0, 0.0, 1.0);
  outDepth = p.z;
  outAxis = projected.axis;
}
