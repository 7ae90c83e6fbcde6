// Marks the voxels of small triangles, see mark_triangle.glsl, and lists the large ones for the rasterizer. One
// invocation per triangle.
#include "lib/triangles.glsl"
#include "shared/passes/listed_triangles.h"
#include "tracing/common/listed_triangles.glsl"
#include "tracing/common/mark_triangle.glsl"
#include "tracing/common/projections.glsl"
#include "tracing/common/touched_voxels.glsl"

layout(local_size_x = TRIANGLE_GROUP) in;
uniform uint triangleCount;

uint triangle = 0u;
ProjectedTriangle projected = ProjectedTriangle(vec3(0.0), vec3(0.0), vec3(0.0), 0);

void visitVoxel(ivec3 voxel) { markTriangle(voxel, triangle, projected.axis); }

void main() {
  triangle = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (triangle >= triangleCount) return;
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  if (!isSmall(a, b, c)) {
    listLargeTriangle(triangle);
    return;
  }
  for (int i = 0; i < projectionCount(); ++i) {
    projected = projectTriangle(a, b, c, i);
    visitSmallTriangle(projected);
  }
}
