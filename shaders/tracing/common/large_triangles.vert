// Conservative rasterization of the large ones of the listed triangles.
#include "tracing/common/listed_triangles.glsl"
#include "tracing/common/triangle_raster.glsl"

layout(location = 0) flat out uint outTriangle;
layout(location = 1) flat out int outAxis;
invariant gl_Position;  // for both steps of a build

void main() {
  outTriangle = listedTriangles[placeOfLarge(uint(gl_VertexID) / 6u)];
  ProjectedTriangle projected = projectTriangle(outTriangle, gl_InstanceID);
  gl_Position = coveringCorner(projected, gl_VertexID % 6);
  outAxis = projected.axis;
}
