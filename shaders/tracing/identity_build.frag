// What becomes of the voxels that a candidate touches. In a build it is counted in the lists of requested voxels, then
// stored there. After a move (MOVE) the voxels are marked, then their lists are given up. Both steps of each are one
// program, so that they see the same fragments whatever the compiler makes of the arithmetic.
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
#else
#define VOXEL_ACCESS readonly
#endif
#include "tracing/voxel_store.glsl"
#include "tracing/voxel_lists.glsl"
#define REQUEST_ACCESS readonly
#include "tracing/requested_voxels.glsl"

uniform int secondStep;
#ifdef MOVE
layout(std430, binding = SSBO_LIST_BUILD) coherent buffer ListBuildBlock { ListBuild listBuild; };
#else
uniform int ownAxis;
layout(std430, binding = SSBO_ENTRIES) writeonly buffer EntryBlock { uint entries[]; };
#endif

layout(location = 0) flat in uint inTriangle;
layout(location = 1) flat in int inAxis;

#ifdef MOVE
void visitVoxel(ivec3 voxel) {
  if (secondStep == 0) {
    markVoxel(voxel, 1u << uint(inAxis));
  } else if (voxelMask(voxel) != 0u) {
    uint list = listOf(voxel), begin = atomicExchange(heads[list].x, LIST_MISSING);
    if (begin < LIST_REQUESTED) atomicAdd(listBuild.stale, heads[list].y - begin);
  }
}
#else
void visitVoxel(ivec3 voxel) {
  // In the A-buffer of the voxel's axis only; where each triangle is drawn in its own, that is it.
  bool inPlace = ownAxis == 1 || (voxelMask(voxel) & (1u << uint(inAxis))) != 0u;
  ivec2 texel = ivec2(gl_FragCoord.xy);
  if (secondStep == 0) countAt(COUNTER_FRAGMENTS, texel);
  if (!inPlace || !requested(voxel)) return;
  uint place = atomicAdd(heads[listOf(voxel)].y, 1u);
  if (secondStep == 1) {
    entries[place] = inTriangle;
    countAt(COUNTER_STORED_X + uint(inAxis), texel);
  }
}
#endif

void main() {
  vec3 a, b, c;
  trianglePositions(inTriangle, a, b, c);
  visitTouchedVoxels(a, b, c, inAxis, ivec2(gl_FragCoord.xy));
}
