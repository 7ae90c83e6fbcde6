// What becomes of the voxels that a candidate touches. In a build it is counted in the lists of requested bricks, then
// stored there: both steps are one program, so that they see the same fragments whatever the compiler makes of the
// arithmetic. After a move (MOVE; voxels are then whole bricks) bricks are marked and their runs given up.
#include "shared/bindings.h"
#include "shared/structs.h"
#include "lib/frame.glsl"
#include "lib/scene.glsl"
#include "tracing/grid.glsl"
#include "tracing/texel_overlap.glsl"
#include "tracing/counters.glsl"
#ifdef MOVE
#define VOXEL_ACCESS coherent
#define VOXEL_WRITE
#define RUN_ACCESS readonly
#else
#define VOXEL_ACCESS readonly
#define RUN_ACCESS
#endif
#include "tracing/voxel_store.glsl"
#include "tracing/bricks.glsl"

#ifdef MOVE
#include "tracing/give_up.glsl"
#else
#include "tracing/brick_build.glsl"
uniform int secondStep;
uniform int ownAxis;
#endif

layout(location = 0) flat in uint inTriangle;
layout(location = 1) flat in int inAxis;

#ifdef MOVE
void visitVoxel(ivec3 brick) {
  markVoxel(brick, 1u << uint(inAxis) | VOXEL_MOVED);
  giveUp(voxelIndex(brick));
}
#else
void visitVoxel(ivec3 voxel) {
  uint brick = brickIndex(brickOf(voxel)), state = bricks[brick];
  // In the A-buffer of the brick's axis only; where each triangle is drawn in its own, that is it.
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
#endif

void main() {
  vec3 a, b, c;
  trianglePositions(inTriangle, a, b, c);
  visitTouchedVoxels(a, b, c, inAxis, ivec2(gl_FragCoord.xy));
}
