// Boxes of all blocks of triangles. One invocation per block.
#include "lib/triangles.glsl"
#include "shared/passes/identity.h"
#include "tracing/identity/triangle_blocks.glsl"

layout(local_size_x = 64) in;
uniform uint triangleCount;

void main() {
  uint block = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  uint first = block * TRIANGLE_BLOCK, end = min(first + TRIANGLE_BLOCK, triangleCount);
  if (first >= end) return;
  ivec3 low = ivec3(1023), high = ivec3(0);
  for (uint triangle = first; triangle < end; ++triangle) {
    vec3 a, b, c;
    trianglePositions(triangle, a, b, c);
    BrickBox box = bricksOf(a, b, c);
    low = min(low, box.low);
    high = max(high, box.high);
  }
  triangleBlocks[block].low = packBrick(low);
  triangleBlocks[block].high = packBrick(high);
}
