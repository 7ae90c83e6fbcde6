// Stores fragments with their attributes: in the A-buffer of their voxel's dominant axis only (single), or of every
// projection (three; Hu et al. 2014).
#define ENTRY_ACCESS writeonly
#include "lib/alpha.glsl"
#include "lib/scene.glsl"
#include "shared/tracing.h"
#include "tracing/attributes/entry.glsl"
#include "tracing/attributes/reserve_entry.glsl"
#include "tracing/common/stored_surface.glsl"
#include "tracing/common/counters.glsl"
#include "tracing/common/grid.glsl"
#include "tracing/common/voxel_store.glsl"

uniform int storeAll;     // 1: three buffers
uniform float texelSize;  // meters, the footprint of a fragment

layout(location = 0) flat in uint inTriangle;
layout(location = 1) flat in int inAxis;
layout(location = 2) in vec3 inBarycentricsDepth;

// Whether this A-buffer is that of the fragment's voxel.
bool wanted(ivec2 texel, float depth) {
  ivec3 voxels = permutedVoxels(inAxis);
  int layer = clamp(int(floor(depth * float(voxels.z))), 0, voxels.z - 1);
  ivec3 cell = ivec3(columnOf(texel, voxels.xy, bufferResolution), layer);
  return (voxelMask(ivec3(unpermute(vec3(cell), inAxis))) & (1u << uint(inAxis))) != 0u;
}

void main() {
  vec2 barycentrics = inBarycentricsDepth.xy;
  float depth = inBarycentricsDepth.z;
  ivec2 texel = ivec2(gl_FragCoord.xy);
  bool covered = true;
  if ((materials[triangleAt(inTriangle).w].flags & MATERIAL_CUT) != 0u) covered = !cutAway(inTriangle, barycentrics);
  if (covered) countAt(COUNTER_FRAGMENTS, texel);
  if (covered && (storeAll == 1 || wanted(texel, depth))) {
    uint entry = reserveEntry(headIndex(inAxis, texel));
    if (entry != noEntry) {
      StoredSurface surface = evaluateStoredSurface(inTriangle, barycentrics, texelSize);
      imageStore(pool, int(entry) * ENTRY_TEXELS, vec4(surface.baseColor, depth));
      imageStore(pool, int(entry) * ENTRY_TEXELS + 1, packNormal(surface.normal, surface.reflectivity, inTriangle));
      countAt(COUNTER_STORED_X + uint(inAxis), texel);
    }
  }
}
