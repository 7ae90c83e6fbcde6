// Lists the triangles that may touch a requested brick. One group per block of triangles, and more than one block per
// group only if there are more than a dispatch takes.
#include "lib/triangles.glsl"
#include "shared/passes/identity.h"
#include "shared/passes/listed_triangles.h"
#include "tracing/common/listed_triangles.glsl"
#include "tracing/common/small_triangle.glsl"
#include "tracing/identity/brick_work.glsl"
#include "tracing/identity/requested_box.glsl"
#include "tracing/identity/triangle_blocks.glsl"

layout(local_size_x = TRIANGLE_GROUP) in;
uniform uint triangleCount;

// Larger triangles are collected without a look at their bricks: voxels decide anyway. A pair of triangle and brick costs
// less than a look at many.
const float maxBricks = 4096.0, maxPairedBricks = 64.0;

void main() {
  bool paired = brickWork.pairGroupsX > 0u;
  for (uint number = gl_WorkGroupID.x; number < brickWork.wantedBlocks; number += gl_NumWorkGroups.x) {
    uint triangle = triangleBlocks[number].wanted * TRIANGLE_BLOCK + gl_LocalInvocationID.x;
    if (triangle >= triangleCount) continue;
    vec3 a, b, c;
    trianglePositions(triangle, a, b, c);
    BrickBox box = bricksOf(a, b, c);
    if (!requestedIn(box.low, box.high, paired ? maxPairedBricks : maxBricks)) continue;
    if (isSmall(a, b, c))
      listSmallTriangle(triangle);
    else if (paired)
      listPairedTriangle(triangle);
    else
      listLargeTriangle(triangle);
  }
}
