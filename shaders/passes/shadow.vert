// Triangles as one view of the shadow maps sees them: by index, or those with holes by number from the draw list.
#include "lib/triangles.glsl"
#include "shared/passes/shadow.h"

uniform mat4 worldToClip;

#ifdef CUT
layout(std430, binding = SSBO_DRAW_LIST) readonly buffer DrawListBlock { uint drawList[]; };

out vec2 barycentrics;
flat out uint triangle;

uint drawnVertex() {
  uint corner = uint(gl_VertexID) % 3u;
  barycentrics = vec2(corner == 1u, corner == 2u);
  triangle = drawList[uint(gl_VertexID) / 3u];
  return triangleAt(triangle)[corner];
}
#else
uint drawnVertex() { return uint(gl_VertexID); }
#endif

void main() { gl_Position = worldToClip * vec4(vertexPosition(drawnVertex()), 1.0); }
