// Triangles of the draw list, pulled by number.
#include "lib/frame.glsl"
#include "lib/triangles.glsl"
#include "shared/passes/gbuffer.h"

layout(std430, binding = SSBO_DRAW_LIST) readonly buffer DrawListBlock { uint drawList[]; };

flat out uint triangle;

void main() {
  triangle = drawList[gl_VertexID / 3];
  uvec4 corners = triangleAt(triangle);
  // Relative to the eye before the rotation: exact even if the scene is much larger than what is seen.
  vec3 relative = vertexPosition(corners[gl_VertexID % 3]) - frame.eye;
  float w = dot(relative, frame.forward);
  float near = frame.drawnNear, far = frame.farPlane;
  float z = far > 0.0 ? near * (far - w) / (far - near) : near;
  vec2 screen = vec2(dot(relative, frame.right) / dot(frame.right, frame.right),
                     dot(relative, frame.up) / dot(frame.up, frame.up));
  // The rasterizer looks at pixel centers: samples come to lie there.
  gl_Position = vec4(screen - sampleShift() * w, z, w);
  if (frame.parallel != 0u) gl_Position = vec4(screen - sampleShift(), (far - w) / (far - near), 1.0);
}
