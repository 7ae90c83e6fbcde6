// What becomes of the voxels that a candidate touches. COUNT: counts it in the lists of requested voxels. FILL: stores it
// there. After a move, OCCUPY: marks the voxels; FORGET: their lists are to be built anew.
#include "shared/bindings.h"
#include "shared/structs.h"
#include "lib/frame.glsl"
#include "lib/when.glsl"
#include "lib/scene.glsl"
#include "tracing/grid.glsl"
#include "tracing/texel_overlap.glsl"
#include "tracing/counters.glsl"
#ifdef OCCUPY
#define VOXEL_ACCESS coherent
#define VOXEL_WRITE
#else
#define VOXEL_ACCESS readonly
#endif
#include "tracing/voxel_store.glsl"
#include "tracing/voxel_lists.glsl"
#define REQUEST_ACCESS readonly
#include "tracing/requested_voxels.glsl"

#ifdef FORGET
layout(std430, binding = SSBO_LIST_BUILD) coherent buffer ListBuildBlock { ListBuild listBuild; };
#endif
#ifdef FILL
layout(std430, binding = SSBO_ENTRIES) writeonly buffer EntryBlock { uint entries[]; };
#endif

layout(location = 0) flat in uint inTriangle;
layout(location = 1) flat in int inAxis;

void visitVoxel(ivec3 voxel) {
#ifdef OCCUPY
  markVoxel(voxel, 1u << uint(inAxis));
#endif
#ifdef FORGET
  uint list = listOf(voxel), begin = atomicExchange(heads[list].x, LIST_MISSING);
  if (begin < LIST_REQUESTED) atomicAdd(listBuild.stale, heads[list].y - begin);
#endif
#ifdef COUNT
  countAt(COUNTER_FRAGMENTS, ivec2(gl_FragCoord.xy));
#endif
#if defined(COUNT) || defined(FILL)
  // In the A-buffer of the voxel's axis only; masks of own axes hold every triangle's own.
  if ((voxelMask(voxel) & (1u << uint(inAxis))) == 0u || !requested(voxel)) return;
  uint place = atomicAdd(heads[listOf(voxel)].y, 1u);
#endif
#ifdef FILL
  entries[place] = inTriangle;
  countAt(COUNTER_STORED_X + uint(inAxis), ivec2(gl_FragCoord.xy));
#endif
}

void main() {
  vec3 a, b, c;
  trianglePositions(inTriangle, a, b, c);
  visitTouchedVoxels(a, b, c, inAxis, ivec2(gl_FragCoord.xy));
}
