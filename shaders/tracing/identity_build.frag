// Stores identity fragments: the triangle's number and the range of depth that it spans over the texel.
#include "shared/bindings.h"
#include "shared/structs.h"
#include "lib/frame.glsl"
#include "lib/when.glsl"
#include "lib/scene.glsl"
#include "tracing/grid.glsl"
#include "tracing/texel_overlap.glsl"
#define PAGE_ACCESS coherent
#define PAGE_WRITE
#include "tracing/pages.glsl"
#define VOXEL_ACCESS readonly
#include "tracing/voxel_store.glsl"
#include "tracing/identity_entry.glsl"

layout(std430, binding = SSBO_ENTRIES) writeonly buffer EntryBlock { uvec2 entries[]; };
uniform int ownAxis;  // 1: the triangle is rasterized in its own axis only, which all its voxels hold

layout(location = 0) flat in uint inTriangle;
layout(location = 1) flat in int inAxis;

// Whether a voxel that the fragment touches has its fragments in this A-buffer.
bool wanted(ivec2 texel, vec2 depths) {
  if (ownAxis == 1) return true;
  // Slack as in the voxel pass; a texel may straddle two columns of voxels.
  vec2 scale = vec2(float(voxelResolution) / float(bufferResolution));
  ivec2 low = ivec2(floor((vec2(texel) - overlapSlack) * scale));
  ivec2 high = ivec2(floor((vec2(texel) + 1.0 + overlapSlack) * scale));
  low = clamp(low, ivec2(0), ivec2(voxelResolution - 1));
  high = clamp(high, ivec2(0), ivec2(voxelResolution - 1));
  int first = clamp(int(floor(depths.x * float(voxelResolution) - overlapSlack)), 0, voxelResolution - 1);
  int last = clamp(int(floor(depths.y * float(voxelResolution) + overlapSlack)), 0, voxelResolution - 1);
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x)
      for (int z = first; z <= last; ++z)
        if ((voxelMask(ivec3(unpermute(vec3(x, y, z), inAxis))) & (1u << uint(inAxis))) != 0u) return true;
  return false;
}

void main() {
  vec3 a, b, c;
  trianglePositions(inTriangle, a, b, c);
  ivec2 texel = ivec2(gl_FragCoord.xy);
  vec2 depths;
  bool touches = touchesTexel(permute(toGrid(a), inAxis), permute(toGrid(b), inAxis), permute(toGrid(c), inAxis), texel,
                              float(bufferResolution), depths);
  bool stored = touches && wanted(texel, depths);
  if (touches && !stored) countAt(COUNTER_FRAGMENTS, texel);
  when (stored) {
    // A fragment ends where its slab does: one that spans several counts in each.
    uvec2 identity = packIdentity(inTriangle, depths);
    vec2 range = identityDepths(identity);
    int last = slabOf(range.y + depthSlack);
    for (int slab = slabOf(range.x - depthSlack); slab <= last; ++slab) {
      countAt(COUNTER_FRAGMENTS, texel);
      uint entry = reserveEntry(headIndex(inAxis, slab, texel));
      if (entry != noEntry) {
        entries[entry] = identity;
        countAt(COUNTER_STORED_X + uint(inAxis), texel);
      }
    }
  }
}
