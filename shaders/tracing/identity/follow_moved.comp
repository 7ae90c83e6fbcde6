// Follows the triangles that have moved: boxes of their blocks, and the bricks that they come to. The grid is that of
// bricks. One group per block of triangles; it shares the texels of a large triangle, which are too many for one
// invocation.
#include "lib/triangles.glsl"
#include "shared/passes/identity.h"
#include "tracing/common/projections.glsl"
#include "tracing/common/touched_voxels.glsl"
#include "tracing/identity/mark_moved.glsl"
#include "tracing/identity/moved_vertices.glsl"
#include "tracing/identity/triangle_blocks.glsl"

layout(local_size_x = TRIANGLE_BLOCK) in;
uniform uint triangleCount;
const uint blocksPerMoved = MOVED_BLOCK / TRIANGLE_BLOCK;

shared int lowX, lowY, lowZ, highX, highY, highZ;
shared uint largeCount, large[TRIANGLE_BLOCK];

int axis = 0;  // that the triangle is seen along

void visitVoxel(ivec3 brick) { markMoved(brick, axis); }

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

void noteBox(BrickBox box) {
  atomicMin(lowX, box.low.x);
  atomicMin(lowY, box.low.y);
  atomicMin(lowZ, box.low.z);
  atomicMax(highX, box.high.x);
  atomicMax(highY, box.high.y);
  atomicMax(highZ, box.high.z);
}

void markLarge(uint triangle) {
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  for (int i = 0; i < projectionCount(); ++i) {
    ProjectedTriangle t = projectTriangle(a, b, c, i);
    TexelBox box = texelBox(t);
    axis = t.axis;
    for (int texel = int(gl_LocalInvocationIndex); texel < box.size.x * box.size.y; texel += TRIANGLE_BLOCK)
      visitTouchedVoxels(t, box.low + ivec2(texel % box.size.x, texel / box.size.x));
  }
}

void main() {
  uint number = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (number / blocksPerMoved >= blockCount) return;
  if (gl_LocalInvocationIndex == 0u) {
    lowX = lowY = lowZ = 1023;
    highX = highY = highZ = 0;
    largeCount = 0u;
  }
  barrier();
  uint block = movedBlock(number / blocksPerMoved) * blocksPerMoved + number % blocksPerMoved;
  uint triangle = block * TRIANGLE_BLOCK + gl_LocalInvocationIndex;
  if (triangle < triangleCount) {
    vec3 a, b, c;
    trianglePositions(triangle, a, b, c);
    noteBox(bricksOf(a, b, c, voxelCount));
    uvec3 corners = triangleAt(triangle).xyz;
    bool follow = hasMoved(corners.x) || hasMoved(corners.y) || hasMoved(corners.z);
    if (follow && !isSmall(a, b, c)) {
      large[atomicAdd(largeCount, 1u)] = triangle;
    } else if (follow) {
      for (int i = 0; i < projectionCount(); ++i) {
        ProjectedTriangle t = projectTriangle(a, b, c, i);
        axis = t.axis;
        visitSmallTriangle(t);
      }
    }
  }
  barrier();
  if (gl_LocalInvocationIndex == 0u && block * TRIANGLE_BLOCK < triangleCount) {
    triangleBlocks[block].low = packBrick(ivec3(lowX, lowY, lowZ));
    triangleBlocks[block].high = packBrick(ivec3(highX, highY, highZ));
  }
  for (uint i = 0u; i < largeCount; ++i) markLarge(large[i]);
}
