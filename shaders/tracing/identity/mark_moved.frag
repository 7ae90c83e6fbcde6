// Bricks that a moved triangle comes to are marked, and their runs given up. Voxels are whole bricks here.
#include "lib/triangles.glsl"
#include "shared/passes/identity.h"
#include "tracing/common/mark_voxel.glsl"
#include "tracing/common/texel_overlap.glsl"
#include "tracing/identity/give_up.glsl"

layout(location = 0) flat in uint inTriangle;
layout(location = 1) flat in int inAxis;

void visitVoxel(ivec3 brick) {
  markVoxel(brick, 1u << uint(inAxis) | VOXEL_MOVED);
  giveUp(voxelIndex(brick));
}

void main() {
  vec3 a, b, c;
  trianglePositions(inTriangle, a, b, c);
  visitTouchedVoxels(a, b, c, inAxis, ivec2(gl_FragCoord.xy));
}
