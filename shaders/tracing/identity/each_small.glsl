// Goes over the small ones of the listed triangles, and over all voxels that each of them touches.
#include "lib/triangles.glsl"
#include "shared/passes/listed_triangles.h"
#include "tracing/common/listed_triangles.glsl"
#include "tracing/common/projections.glsl"
#include "tracing/common/touched_voxels.glsl"

layout(local_size_x = TRIANGLE_GROUP) in;

uint triangle = 0u;
ProjectedTriangle projected = ProjectedTriangle(vec3(0.0), vec3(0.0), vec3(0.0), 0);

// Called when a projection is done. The program that includes this file defines it.
void endProjection();

void main() {
  // More than one triangle per invocation only if there are more than a dispatch takes.
  uint stride = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  for (uint number = gl_GlobalInvocationID.x; number < listed.smallCount; number += stride) {
    triangle = listedTriangles[number];
    vec3 a, b, c;
    trianglePositions(triangle, a, b, c);
    for (int i = 0; i < projectionCount(); ++i) {
      projected = projectTriangle(a, b, c, i);
      visitSmallTriangle(projected);
      endProjection();
    }
  }
}
