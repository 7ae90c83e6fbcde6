// Triangles of the draw list, pulled by number.
#include "lib/scene.glsl"

layout(std430, binding = SSBO_DRAW_LIST) readonly buffer DrawListBlock { uint drawList[]; };

flat out uint triangle;

void main() {
  triangle = drawList[gl_VertexID / 3];
  uvec4 corners = triangleAt(triangle);
  // Relative to the eye before the rotation: exact also where the scene is much larger than what is seen.
  vec3 relative = vertexPosition(corners[gl_VertexID % 3]) - frame.eye.xyz;
  float w = dot(relative, frame.forward.xyz);
  float near = frame.forward.w, far = frame.right.w;
  float z = far > 0.0 ? near * (far - w) / (far - near) : near;
  gl_Position = vec4(dot(relative, frame.right.xyz) / dot(frame.right.xyz, frame.right.xyz),
                     dot(relative, frame.up.xyz) / dot(frame.up.xyz, frame.up.xyz), z, w);
}
