// Conservative rasterization of the candidates.
#define CONSERVATIVE
#include "shared/bindings.h"
#include "shared/structs.h"
#include "lib/frame.glsl"
#include "lib/scene.glsl"
#include "tracing/grid.glsl"
#include "tracing/triangle_normal.glsl"
#include "tracing/triangle_raster.glsl"

layout(std430, binding = SSBO_LINKS) readonly buffer CandidateBlock { uint candidates[]; };

layout(location = 0) flat out uint outTriangle;
layout(location = 1) flat out int outAxis;

void main() {
  outTriangle = candidates[gl_VertexID / 6];
  ProjectedTriangle projected = projectTriangle(outTriangle, gl_InstanceID);
  gl_Position = coveringCorner(projected, gl_VertexID % 6);
  outAxis = projected.axis;
}
