// Pixels whose reflection is traced, compacted into a queue. A batch is a band of the screen.
#include "lib/blend.glsl"
#include "lib/display.glsl"
#include "shared/passes/spawn.h"
#include "shared/rays.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430, binding = SSBO_RAYS) writeonly buffer RayBlock { uint queuedPixels[]; };
layout(std430, binding = SSBO_RAY_COUNT) buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_CONTRIBUTIONS) buffer ContributionBlock { uint contributions[CONTRIBUTION_CLASSES]; };

uniform int firstRow;  // of the band

shared uint selectedMask[2];
shared uint keptMask[2];
shared uint firstRay;

const uint SELECT_ALL = 2u;
const uint PATTERN_REGION = 1u;

// A pixel is kept by fractions above its threshold, so that smaller fractions are parts of larger ones.

// The ordered dither of 256 x 256 pixels (Bayer 1973): every value occurs once in a tile and the pixels below any value
// are spread evenly.
float scatteredThreshold(uvec2 pixel) {
  uint rank = 0u;
  for (uint bit = 0u; bit < 8u; ++bit) {
    uint x = (pixel.x >> bit) & 1u, y = (pixel.y >> bit) & 1u;
    rank |= ((x ^ y) << 1u | y) << (2u * (7u - bit));
  }
  return (float(rank) + 0.5) / 65536.0;
}

// The share of the screen that the rectangle of the screen's shape around its center takes when it reaches the pixel.
float regionThreshold(ivec2 pixel) {
  vec2 fromCenter = abs(screenPosition(pixel));
  float side = max(fromCenter.x, fromCenter.y);
  return side * side;
}

// What the reflection of something as bright as white adds to the displayed color: 0..1, the largest of its components.
float contribution(ivec2 pixel, vec4 position, vec3 normal) {
  Blend blend = blendOf(pixel, position, normal);
  vec3 added = displayed(blend.base + blend.share / frame.exposure) - displayed(blend.base);
  return max(max(added.r, added.g), added.b);
}

// Pixels whose contributions are within a quarter of an octave are thinned out evenly: a mirror that contributes the
// same everywhere must not vanish at once.
const float EQUAL_OCTAVES = 0.25;

uint contributionClass(float contribution) {
  float fromLeast = log2(max(contribution, exp2(-float(CONTRIBUTION_OCTAVES)))) + float(CONTRIBUTION_OCTAVES);
  return min(uint(fromLeast * float(CONTRIBUTION_CLASSES / CONTRIBUTION_OCTAVES)), uint(CONTRIBUTION_CLASSES) - 1u);
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
  bool kept = false;
  float scattered = scatteredThreshold(uvec2(pixel));
  float threshold = frame.selectPattern == PATTERN_REGION ? regionThreshold(pixel) : scattered;
  if (selected && threshold < frame.selectFraction) {
    float worth = contribution(pixel, position, normal.xyz) * exp2(-EQUAL_OCTAVES * scattered);
    atomicAdd(contributions[contributionClass(worth)], 1u);
    kept = frame.minContribution <= 0.0 || worth > frame.minContribution;
  }
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
