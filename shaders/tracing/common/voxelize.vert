// Rasterizes the scene for the voxel grid: the projected corners, or those between shifted edges.
#include "tracing/common/shifted_edges.glsl"
#include "tracing/common/triangle_raster.glsl"

layout(location = 0) flat out uint outTriangle;
layout(location = 1) flat out int outAxis;
#ifndef SHIFTED
layout(location = 2) out float outDepth;
#endif

void main() {
  outTriangle = uint(gl_VertexID) / 3u;
  ProjectedTriangle projected = projectTriangle(outTriangle, gl_InstanceID);
  int corner = gl_VertexID % 3;
  outAxis = projected.axis;
#ifdef SHIFTED
  gl_Position = shiftedCorner(projected, corner, float(rasterResolution));
#else
  vec3 p = corner == 0 ? projected.a : (corner == 1 ? projected.b : projected.c);
  gl_Position = vec4(p.xy * 2.0 - 1.0, 0.0, 1.0);
  outDepth = p.z;
#endif
}
