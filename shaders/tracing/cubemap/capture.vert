// One face of the cube: triangles of the draw list, pulled by number.
#include "lib/triangles.glsl"
#include "shared/passes/gbuffer.h"
#include "tracing/cubemap/faces.glsl"

layout(std430, binding = SSBO_DRAW_LIST) readonly buffer DrawListBlock { uint drawList[]; };
uniform int face;

layout(location = 0) flat out uint triangle;

void main() {
  triangle = drawList[gl_VertexID / 3];
  vec3 p = toFace(vertexPosition(triangleAt(triangle)[gl_VertexID % 3]) - probe.xyz, face);
  gl_Position = vec4(p.xy, probe.w, p.z);  // reversed depth in 0..1
}
