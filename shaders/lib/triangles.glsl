// The scene's triangles, pulled from storage buffers: where they are, not what they look like.
#include "shared/bindings.h"

layout(std430, binding = SSBO_POSITIONS) restrict readonly buffer PositionBlock { float positions[]; };
layout(std430, binding = SSBO_TRIANGLES) restrict readonly buffer TriangleBlock { uvec4 triangles[]; };

vec3 vertexPosition(uint vertex) {
  return vec3(positions[3u * vertex], positions[3u * vertex + 1u], positions[3u * vertex + 2u]);
}

// xyz: vertices; w: material.
uvec4 triangleAt(uint triangle) { return triangles[triangle]; }

void trianglePositions(uint triangle, out vec3 a, out vec3 b, out vec3 c) {
  uvec4 corners = triangles[triangle];
  a = vertexPosition(corners.x);
  b = vertexPosition(corners.y);
  c = vertexPosition(corners.z);
}

// Whether a ray meets the side from which its corners run counterclockwise.
bool meetsFront(uint triangle, vec3 direction) {
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  return dot(cross(b - a, c - a), direction) < 0.0;
}
