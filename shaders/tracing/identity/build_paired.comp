// The entries of the large triangles in a build of few bricks: the rasterizer would visit all of their voxels for the few
// in these. One group per build, whose invocations share the triangles.
#include "lib/triangles.glsl"
#include "shared/passes/listed_triangles.h"
#include "tracing/common/listed_triangles.glsl"
#include "tracing/common/projections.glsl"
#include "tracing/common/touched_voxels.glsl"
#include "tracing/identity/add_entry.glsl"
#include "tracing/identity/brick_work.glsl"
#include "tracing/identity/triangle_blocks.glsl"

layout(local_size_x = TRIANGLE_GROUP) in;

uint triangle = 0u;
int axis = 0;

void visitVoxel(ivec3 voxel) { addEntry(voxel, triangle, axis); }

// The voxels of a brick that the triangle touches.
void visitBrick(ProjectedTriangle t, ivec3 brick) {
  axis = t.axis;
  ivec3 low = ivec3(permute(vec3(brick << BRICK_SHIFT), axis));
  for (int i = 0; i < BRICK_SIDE * BRICK_SIDE; ++i) {
    ivec2 texel = low.xy + ivec2(i % BRICK_SIDE, i / BRICK_SIDE);
    ivec2 depths = touchedDepths(t, texel);
    int last = min(depths.y, low.z + BRICK_SIDE - 1);
    for (int depth = max(depths.x, low.z); depth <= last; ++depth)
      visitVoxel(ivec3(unpermute(vec3(texel, depth), axis)));
  }
}

void main() {
  uint build = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (build >= brickWork.buildCount) return;
  ivec3 brick = brickAt(requests[build].brick);
  uint number = gl_LocalInvocationIndex, count = listed.pairedCount;
  while (number < count) {
    // The next one whose box holds the brick.
    vec3 a, b, c;
    bool near = false;
    for (; number < count && !near; number += TRIANGLE_GROUP) {
      triangle = listedTriangles[placeOfLarge(number)];
      trianglePositions(triangle, a, b, c);
      near = holds(bricksOf(a, b, c), brick);
    }
    for (int i = 0; i < projectionCount() && near; ++i) {
      visitBrick(projectTriangle(a, b, c, i), brick);
      countEntries(axis, ivec2(gl_LocalInvocationIndex % 8u, gl_LocalInvocationIndex / 8u));
    }
  }
}
