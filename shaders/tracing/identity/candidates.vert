// Conservative rasterization of the candidates.
#include "shared/passes/identity.h"
#include "tracing/common/triangle_raster.glsl"

layout(std430, binding = SSBO_CANDIDATES) readonly buffer CandidateBlock { uint candidates[]; };

layout(location = 0) flat out uint outTriangle;
layout(location = 1) flat out int outAxis;

void main() {
  outTriangle = candidates[gl_VertexID / 6];
  ProjectedTriangle projected = projectTriangle(outTriangle, gl_InstanceID);
  gl_Position = coveringCorner(projected, gl_VertexID % 6);
  outAxis = projected.axis;
}
