// Pixels whose reflection is traced, and all whose surface blends: their rays go on behind it.
// With BY_CONTRIBUTION, which reads the shaded G-buffer, pixels that contribute too little are left out, and all are
// counted by their contribution; otherwise contributions.comp counts them.
#include "effects/common/queue_pixels.glsl"
#include "lib/gbuffer.glsl"
#include "shared/passes/spawn.h"
#ifdef BY_CONTRIBUTION
#include "effects/reflection/contribution.glsl"

layout(std430, binding = SSBO_CONTRIBUTIONS) buffer ContributionBlock { uint contributions[CONTRIBUTION_CLASSES]; };
#endif

const uint SELECT_ALL = 2u;

void main() {
  ivec2 pixel = bandPixel();
  beginTile();
  bool selected = false, behind = false;
  vec4 normal = vec4(0.0);
  if (all(lessThan(pixel, ivec2(frame.width, frame.height)))) {
    normal = facingAt(pixel);
    bool reflects = frame.selectMode == SELECT_ALL || normal.w > frame.minReflectivity;
    behind = goesOn(normal);
    selected = frame.selectMode != 0u && isSurface(normal) && reflects && !behind;
  }
  bool kept = selected && inFraction(pixel);
#ifdef BY_CONTRIBUTION
  if (kept) {
    float worth = contributionOf(pixel, normal);
    atomicAdd(contributions[contributionClass(worth)], 1u);
    kept = worth > frame.minContribution;
  }
#endif
  if (behind) atomicAdd(rayCount.byKind[RAY_THROUGH], 1u);
  queuePixel(pixel, selected, kept || behind);
}
