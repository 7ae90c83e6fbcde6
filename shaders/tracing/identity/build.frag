// A candidate's entries in the lists of requested bricks: counted, then stored. Both steps are one program, so that
// they see the same fragments whatever the compiler makes of the arithmetic.
#define RUN_ACCESS
#include "lib/triangles.glsl"
#include "shared/tracing.h"
#include "tracing/common/counters.glsl"
#include "tracing/common/texel_overlap.glsl"
#include "tracing/common/voxel_store.glsl"
#include "tracing/identity/brick_build.glsl"
#include "tracing/identity/bricks.glsl"

uniform int secondStep;
uniform int ownAxis;

layout(location = 0) flat in uint inTriangle;
layout(location = 1) flat in int inAxis;

void visitVoxel(ivec3 voxel) {
  uint brick = brickIndex(brickOf(voxel)), state = bricks[brick];
  // In the A-buffer of the brick's axis only. With own axes that is the axis in which the triangle is drawn.
  bool inPlace = ownAxis == 1 || (voxelMaskAt(brick) & (1u << uint(inAxis))) != 0u;
  ivec2 texel = ivec2(gl_FragCoord.xy);
  if (secondStep == 0) countAt(COUNTER_FRAGMENTS, texel);
  if (!inPlace || !requested(state)) return;
  uint place = atomicAdd(builds[state - BRICK_REQUESTED].next[voxelInBrick(voxel)], 1u);
  if (secondStep == 1) {
    runs[place] = inTriangle;
    countAt(COUNTER_STORED_X + uint(inAxis), texel);
  }
}

void main() {
  vec3 a, b, c;
  trianglePositions(inTriangle, a, b, c);
  visitTouchedVoxels(a, b, c, inAxis, ivec2(gl_FragCoord.xy));
}
