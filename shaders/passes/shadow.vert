// Triangles as one view of the shadow maps sees them: by index, or those with holes by number from the draw list.
#include "lib/triangles.glsl"
#include "shared/passes/shadow.h"
#ifdef CUT
#include "lib/alpha.glsl"
#endif

uniform mat4 worldToClip;

#ifdef CUT
layout(std430, binding = SSBO_DRAW_LIST) readonly buffer DrawListBlock { uint drawList[]; };

out vec2 barycentrics;
// Of the whole triangle, fetched here once instead of at every texel.
flat out CutTriangle cut;

uint drawnVertex() {
  uint corner = uint(gl_VertexID) % 3u;
  barycentrics = vec2(corner == 1u, corner == 2u);
  uvec4 corners = triangleAt(drawList[uint(gl_VertexID) / 3u]);
  cut = cutTriangle(corners, false);
  return corners[corner];
}
#else
uint drawnVertex() { return uint(gl_VertexID); }
#endif

void main() { gl_Position = worldToClip * vec4(vertexPosition(drawnVertex()), 1.0); }
