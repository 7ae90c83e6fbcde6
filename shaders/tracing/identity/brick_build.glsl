// Bricks that rays wait for, while they are built by one step after the other; numbered as their requests.
#include "shared/passes/identity.h"
#include "tracing/identity/brick_requests.glsl"

struct BrickBuild {
  uint next[VOXELS_PER_BRICK];  // entries counted for each voxel; then where its next entry goes
};
layout(std430, binding = SSBO_BRICK_BUILDS) coherent buffer BrickBuildBlock { BrickBuild builds[]; };

// Lists and entries of a build's run.
uvec2 listsAndEntries(uint build) {
  uvec2 sum = uvec2(0u);
  for (uint i = 0u; i < VOXELS_PER_BRICK; ++i) {
    uint count = builds[build].next[i];
    sum += uvec2(count > 0u ? 1u : 0u, count);
  }
  return sum;
}

// Its words: a bit per voxel, where the lists end, the entries.
uint wordsOf(uvec2 listsAndEntries) { return 2u + listsAndEntries.x + listsAndEntries.y; }
