// The bricks that large moved triangles come to.
#include "lib/triangles.glsl"
#include "tracing/common/projections.glsl"
#include "tracing/common/touched_voxels.glsl"
#include "tracing/identity/mark_moved.glsl"

layout(location = 0) flat in uint inTriangle;
layout(location = 1) flat in int inAxis;

void visitVoxel(ivec3 brick) { markMoved(brick, inAxis); }

void main() {
  vec3 a, b, c;
  trianglePositions(inTriangle, a, b, c);
  visitTouchedVoxels(projectAlong(a, b, c, inAxis), ivec2(gl_FragCoord.xy));
}
