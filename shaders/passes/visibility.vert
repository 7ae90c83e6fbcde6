// Triangles of the draw list, pulled by number.
#include "lib/projection.glsl"
#include "lib/triangles.glsl"
#include "shared/passes/gbuffer.h"

layout(std430, binding = SSBO_DRAW_LIST) readonly buffer DrawListBlock { uint drawList[]; };

flat out uint triangle;

void main() {
  triangle = drawList[gl_VertexID / 3];
  gl_Position = projected(vertexPosition(triangleAt(triangle)[gl_VertexID % 3]));
}
