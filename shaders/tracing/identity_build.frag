// Identity fragments of requested voxels: counts them (FILL off), or stores each in its list.
#include "shared/bindings.h"
#include "shared/structs.h"
#include "lib/frame.glsl"
#include "lib/when.glsl"
#include "lib/scene.glsl"
#include "tracing/grid.glsl"
#include "tracing/texel_overlap.glsl"
#include "tracing/counters.glsl"
#define VOXEL_ACCESS readonly
#include "tracing/voxel_store.glsl"
#include "tracing/voxel_lists.glsl"
#define REQUEST_ACCESS readonly
#include "tracing/requested_voxels.glsl"

#ifdef FILL
layout(std430, binding = SSBO_ENTRIES) writeonly buffer EntryBlock { uint entries[]; };
#endif

layout(location = 0) flat in uint inTriangle;
layout(location = 1) flat in int inAxis;

void visitVoxel(ivec3 voxel) {
  // In the A-buffer of the voxel's axis only; masks of own axes hold every triangle's own.
  bool stored = (voxelMask(voxel) & (1u << uint(inAxis))) != 0u && requested(voxel);
#ifdef FILL
  if (stored) {
    entries[atomicAdd(heads[listOf(voxel)].y, 1u)] = inTriangle;
    countAt(COUNTER_STORED_X + uint(inAxis), ivec2(gl_FragCoord.xy));
  }
#else
  countAt(COUNTER_FRAGMENTS, ivec2(gl_FragCoord.xy));
  if (stored) atomicAdd(heads[listOf(voxel)].y, 1u);
#endif
}

void main() {
  vec3 a, b, c;
  trianglePositions(inTriangle, a, b, c);
  visitTouchedVoxels(a, b, c, inAxis, ivec2(gl_FragCoord.xy));
}
