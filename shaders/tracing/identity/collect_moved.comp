// Lists the triangles with a moved vertex.
#include "lib/triangles.glsl"
#include "tracing/identity/collect.glsl"

uniform uint firstVertex;
uniform uint vertexCount;

void main() {
  uint triangle = invocationTriangle();
  if (triangle >= triangleCount) return;
  uvec3 corners = triangleAt(triangle).xyz;
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  // Numbers below the first wrap around.
  if (any(lessThan(corners - firstVertex, uvec3(vertexCount)))) listTriangle(triangle, a, b, c);
}
