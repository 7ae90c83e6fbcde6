// The entries of the small ones of the listed triangles.
#include "lib/triangles.glsl"
#include "shared/passes/listed_triangles.h"
#include "tracing/common/listed_triangles.glsl"
#include "tracing/common/projections.glsl"
#include "tracing/common/touched_voxels.glsl"
#include "tracing/identity/add_entry.glsl"

layout(local_size_x = TRIANGLE_GROUP) in;

uint triangle = 0u;
int axis = 0;

void visitVoxel(ivec3 voxel) { addEntry(voxel, triangle, axis); }

void main() {
  // More than one triangle per invocation only if there are more than a dispatch takes.
  uint stride = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  for (uint number = gl_GlobalInvocationID.x; number < listed.smallCount; number += stride) {
    triangle = listedTriangles[number];
    vec3 a, b, c;
    trianglePositions(triangle, a, b, c);
    for (int i = 0; i < projectionCount(); ++i) {
      ProjectedTriangle projected = projectTriangle(a, b, c, i);
      axis = projected.axis;
      visitSmallTriangle(projected);
      countEntries(axis, ivec2(gl_LocalInvocationIndex % 8u, gl_LocalInvocationIndex / 8u));
    }
  }
}
