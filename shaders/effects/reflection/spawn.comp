// Pixels whose reflection is traced, compacted into a queue. A batch is a band of the screen.
// With BY_CONTRIBUTION, which reads the shaded G-buffer, pixels that contribute too little are left out, and all are
// counted by their contribution; otherwise contributions.comp counts them.
#include "effects/reflection/dither.glsl"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "shared/passes/spawn.h"
#include "shared/rays.h"
#ifdef BY_CONTRIBUTION
#include "effects/reflection/contribution.glsl"
#endif

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430, binding = SSBO_RAYS) writeonly buffer RayBlock { uint queuedPixels[]; };
layout(std430, binding = SSBO_RAY_COUNT) buffer RayCountBlock { RayCount rayCount; };
#ifdef BY_CONTRIBUTION
layout(std430, binding = SSBO_CONTRIBUTIONS) buffer ContributionBlock { uint contributions[CONTRIBUTION_CLASSES]; };
#endif

uniform int firstRow;  // of the band

shared uint selectedMask[2];
shared uint keptMask[2];
shared uint firstRay;

const uint SELECT_ALL = 2u;
const uint PATTERN_REGION = 1u;

// A pixel is kept by fractions above its threshold, so that smaller fractions are parts of larger ones.

// The share of the screen that the rectangle of the screen's shape around its center takes when it reaches the pixel.
float regionThreshold(ivec2 pixel) {
  vec2 fromCenter = abs(screenPosition(pixel));
  float side = max(fromCenter.x, fromCenter.y);
  return side * side;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(0, firstRow);
  uint lane = gl_LocalInvocationIndex;
  if (lane < 2u) {
    selectedMask[lane] = 0u;
    keptMask[lane] = 0u;
  }
  barrier();

  bool selected = false;
  vec4 position = vec4(0.0), normal = vec4(0.0);
  if (all(lessThan(pixel, ivec2(frame.width, frame.height)))) {
    position = texelFetch(gPosition, pixel, 0);
    normal = texelFetch(gNormal, pixel, 0);
    bool reflects = frame.selectMode == SELECT_ALL || normal.w > frame.minReflectivity;
    selected = frame.selectMode != 0u && position.w > 0.0 && reflects;
  }
  float threshold = frame.selectPattern == PATTERN_REGION ? regionThreshold(pixel) : scatteredThreshold(uvec2(pixel));
  bool kept = selected && threshold < frame.selectFraction;
#ifdef BY_CONTRIBUTION
  if (kept) {
    float worth = contributionOf(pixel, position, normal.xyz);
    atomicAdd(contributions[contributionClass(worth)], 1u);
    kept = worth > frame.minContribution;
  }
#endif
  uint word = lane >> 5, bit = 1u << (lane & 31u);
  if (selected) atomicOr(selectedMask[word], bit);
  if (kept) atomicOr(keptMask[word], bit);
  barrier();

  if (lane == 0u) {
    uint count = bitCount(keptMask[0]) + bitCount(keptMask[1]);
    firstRay = count == 0u ? 0u : atomicAdd(rayCount.count, count);
    uint before = bitCount(selectedMask[0]) + bitCount(selectedMask[1]);
    if (before != 0u) atomicAdd(rayCount.reflecting, before);
  }
  barrier();
  if (!kept) return;

  uint index = firstRay + (word == 0u ? 0u : bitCount(keptMask[0])) + bitCount(keptMask[word] & (bit - 1u));
  queuedPixels[index] = uint(pixel.y) * frame.width + uint(pixel.x);
}
