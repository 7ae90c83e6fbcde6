// Conservative rasterization for identity fragments.
#define CONSERVATIVE
#include "shared/bindings.h"
#include "shared/structs.h"
#include "lib/frame.glsl"
#include "lib/scene.glsl"
#include "tracing/grid.glsl"
#include "tracing/triangle_normal.glsl"
#include "tracing/triangle_raster.glsl"

layout(location = 0) flat out uint outTriangle;
layout(location = 1) flat out int outAxis;

void main() {
  outTriangle = uint(gl_VertexID) / 6u;
  ProjectedTriangle projected = projectTriangle(outTriangle, gl_InstanceID);
  gl_Position = coveringCorner(projected, gl_VertexID % 6);
  outAxis = projected.axis;
}
