// Collects the triangles with a moved vertex. One invocation per triangle.
#include "lib/triangles.glsl"
#include "tracing/identity/candidates.glsl"

uniform uint firstVertex;
uniform uint vertexCount;

void main() {
  uint triangle = invocationTriangle();
  if (triangle >= triangleCount) return;
  uvec3 corners = triangleAt(triangle).xyz;
  // Numbers below the first wrap around.
  if (any(lessThan(corners - firstVertex, uvec3(vertexCount)))) addCandidate(triangle);
}
