// Pixels of 8 x 8 tiles, compacted into a queue. A batch is a band of the screen.
#include "effects/common/dither.glsl"
#include "lib/frame.glsl"
#include "shared/rays.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430, binding = SSBO_RAYS) writeonly buffer RayBlock { uint queuedPixels[]; };
layout(std430, binding = SSBO_RAY_COUNT) buffer RayCountBlock { RayCount rayCount; };

uniform int firstRow;  // of the band

shared uint selectedMask[2];
shared uint keptMask[2];
shared uint firstRay;

const uint PATTERN_REGION = 1u;

ivec2 bandPixel() { return ivec2(gl_GlobalInvocationID.xy) + ivec2(0, firstRow); }

// A pixel is kept by fractions above its threshold, so that smaller fractions are parts of larger ones.

// The share of the screen that the rectangle of the screen's shape around its center takes when it reaches the pixel.
float regionThreshold(ivec2 pixel) {
  vec2 fromCenter = abs(screenPosition(pixel));
  float side = max(fromCenter.x, fromCenter.y);
  return side * side;
}

bool inFraction(ivec2 pixel) {
  float threshold = frame.selectPattern == PATTERN_REGION ? regionThreshold(pixel) : scatteredThreshold(uvec2(pixel));
  return threshold < frame.selectFraction;
}

// Before the pixels are queued.
void beginTile() {
  uint lane = gl_LocalInvocationIndex;
  if (lane < 2u) {
    selectedMask[lane] = 0u;
    keptMask[lane] = 0u;
  }
  barrier();
}

// Called by all of a tile.
void queuePixel(ivec2 pixel, bool selected, bool kept) {
  uint lane = gl_LocalInvocationIndex;
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
