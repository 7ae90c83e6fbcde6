// Draws the scene along its axes into three images side by side, one draw for all three: each triangle into that of the
// axis that it faces most, or with three instances into all (Buerger et al. 2007, section 1.2.1, has a geometry shader
// choose among three targets). The grid is padded, so no triangle reaches into the next image.
#include "lib/triangles.glsl"
#include "shared/passes/gbuffer.h"
#include "tracing/common/projections.glsl"

layout(std430, binding = SSBO_DRAW_LIST) readonly buffer DrawListBlock { uint drawList[]; };

layout(location = 0) flat out uint outTriangle;
layout(location = 1) out vec3 outBarycentricsDepth;

void main() {
  outTriangle = drawList[gl_VertexID / 3];
  vec3 a, b, c;
  trianglePositions(outTriangle, a, b, c);
  ProjectedTriangle projected = projectTriangle(a, b, c, gl_InstanceID);
  int corner = gl_VertexID % 3;
  vec3 p = corner == 0 ? projected.a : (corner == 1 ? projected.b : projected.c);
  gl_Position = vec4((p.x + float(projected.axis)) * (2.0 / 3.0) - 1.0, p.y * 2.0 - 1.0, 0.0, 1.0);
  outBarycentricsDepth = vec3(corner == 1 ? 1.0 : 0.0, corner == 2 ? 1.0 : 0.0, p.z);
}
