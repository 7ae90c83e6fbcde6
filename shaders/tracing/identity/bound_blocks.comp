// Boxes of the blocks of triangles that have moved. One invocation per block.
#include "lib/triangles.glsl"
#include "shared/passes/identity.h"
#include "tracing/identity/moved_vertices.glsl"
#include "tracing/identity/triangle_blocks.glsl"

layout(local_size_x = 64) in;
uniform uint triangleCount;
const uint blocksPerMoved = MOVED_BLOCK / TRIANGLE_BLOCK;

void main() {
  uint number = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (number / blocksPerMoved >= blockCount) return;
  uint block = movedBlock(number / blocksPerMoved) * blocksPerMoved + number % blocksPerMoved;
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
