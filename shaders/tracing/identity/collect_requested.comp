// Lists the triangles that may touch a requested brick.
#include "lib/triangles.glsl"
#include "shared/passes/identity.h"
#include "tracing/common/grid.glsl"
#include "tracing/identity/bricks.glsl"
#include "tracing/identity/collect.glsl"

// Larger triangles are collected without a look at their bricks: fragments decide anyway.
const int maxBricks = 4096;

// `a`, `b`, `c` in world space.
bool wantedTriangle(vec3 a, vec3 b, vec3 c) {
  ivec3 count = voxelCount / BRICK_SIDE;
  a = toGrid(a) * vec3(count);
  b = toGrid(b) * vec3(count);
  c = toGrid(c) * vec3(count);
  // Slack beyond that of the fragments, which decide.
  ivec3 low = clamp(ivec3(floor(min(a, min(b, c)) - 0.05)), ivec3(0), count - 1);
  ivec3 high = clamp(ivec3(floor(max(a, max(b, c)) + 0.05)), ivec3(0), count - 1);
  vec3 size = vec3(high - low + 1);
  bool wanted = size.x * size.y * size.z > float(maxBricks);
  for (int z = low.z; z <= high.z && !wanted; ++z)
    for (int y = low.y; y <= high.y && !wanted; ++y)
      for (int x = low.x; x <= high.x && !wanted; ++x) wanted = requested(bricks[brickIndex(ivec3(x, y, z))]);
  return wanted;
}

void main() {
  uint triangle = invocationTriangle();
  if (triangle >= triangleCount) return;
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  if (wantedTriangle(a, b, c)) listTriangle(triangle, a, b, c);
}
