// The scene mirrored at the plane, as the camera sees it: triangles of the draw list, pulled by number.
#include "lib/projection.glsl"
#include "lib/triangles.glsl"
#include "shared/passes/gbuffer.h"
#include "tracing/planar/mirrored.glsl"

layout(std430, binding = SSBO_DRAW_LIST) readonly buffer DrawListBlock { uint drawList[]; };

layout(location = 0) flat out uint triangle;
layout(location = 1) out float before;  // the mirror, meters

void main() {
  triangle = drawList[gl_VertexID / 3];
  vec3 position = vertexPosition(triangleAt(triangle)[gl_VertexID % 3]);
  before = beforeMirror(position);
  gl_Position = projected(mirroredPoint(position));
}
