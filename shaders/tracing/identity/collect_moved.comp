// Lists the triangles with a moved vertex. One invocation per triangle of the blocks that may have some.
#include "lib/triangles.glsl"
#include "shared/passes/identity.h"
#include "tracing/identity/collect.glsl"
#include "tracing/identity/moved_vertices.glsl"

bool hasMoved(uint vertex) {
  // Ranges that begin at the vertex or before it.
  uint low = 0u;
  for (uint high = rangeCount; low < high;) {
    uint middle = (low + high) / 2u;
    if (moved[2u * middle] <= vertex)
      low = middle + 1u;
    else
      high = middle;
  }
  return low > 0u && vertex < moved[2u * low - 1u];
}

void main() {
  uint number = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (number / MOVED_BLOCK >= blockCount) return;
  uint triangle = movedBlock(number / MOVED_BLOCK) * MOVED_BLOCK + number % MOVED_BLOCK;
  if (triangle >= triangleCount) return;
  uvec3 corners = triangleAt(triangle).xyz;
  if (!hasMoved(corners.x) && !hasMoved(corners.y) && !hasMoved(corners.z)) return;
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  listTriangle(triangle, a, b, c);
}
