// Triangles of the draw list as one view of the shadow maps sees them.
#include "lib/triangles.glsl"
#include "shared/passes/shadow.h"

layout(std430, binding = SSBO_DRAW_LIST) readonly buffer DrawListBlock { uint drawList[]; };

uniform mat4 worldToClip;

#ifdef CUT
out vec2 barycentrics;
flat out uint triangle;
#endif

void main() {
  uint corner = uint(gl_VertexID) % 3u;
  uint number = drawList[uint(gl_VertexID) / 3u];
#ifdef CUT
  barycentrics = vec2(corner == 1u, corner == 2u);
  triangle = number;
#endif
  gl_Position = worldToClip * vec4(vertexPosition(triangleAt(number)[corner]), 1.0);
}
