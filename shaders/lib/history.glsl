// Colors of earlier frames: where to read them and what of them can still be true.
#include "shared/passes/temporal.h"

// Three numbers of nine bits and a common exponent, 0 to 65,408: off by at most 1/512 of the largest.
float powerOfTwo(int exponent) { return uintBitsToFloat(uint(exponent + 127) << 23); }
uint packRadiance(vec3 c) {
  const float LEAST = 1.0 / 65536.0;  // of an exponent of its own
  c = min(max(c, 0.0), 65408.0);
  float largest = max(max(c.r, c.g), max(c.b, LEAST));
  int exponent = int(floatBitsToUint(largest) >> 23) - 126;  // the largest is 1/2 to 1 of its power
  if (largest * powerOfTwo(9 - exponent) >= 511.5) ++exponent;
  uvec3 mantissas = uvec3(c * powerOfTwo(9 - exponent) + 0.5);
  return mantissas.r | mantissas.g << 9 | mantissas.b << 18 | uint(exponent + 15) << 27;
}
vec3 unpackRadiance(uint bits) {
  float unit = powerOfTwo(int(bits >> 27) - 24);
  return unit * vec3(bits & 511u, bits >> 9 & 511u, bits >> 18 & 511u);
}

// What a frame shows in a pixel, and how many pixels that has moved since the frame before.
uvec2 packSample(vec3 radiance, vec2 motion) { return uvec2(packRadiance(radiance), packHalf2x16(motion)); }

// How much of the next sample a place shows that lies `between` a sample and that one, 0..1. A sample stands for a
// square one pixel wide with edges a little soft: sharp ones would count it or not as the place moves by nothing, softer
// ones blur.
vec2 shareOfNext(vec2 between) {
  const float SOFTNESS = 0.6;  // pixels
  return clamp((between - 0.5) / SOFTNESS + 0.5, 0.0, 1.0);
}

// Brightness and two differences of colors, compressed as a display would: there, distances are what an eye sees.
vec3 toPerceived(vec3 radiance, float exposure) {
  vec3 c = radiance * exposure;
  c /= 1.0 + max(max(c.r, c.g), c.b);
  return vec3(0.25 * c.r + 0.5 * c.g + 0.25 * c.b, 0.5 * c.r - 0.5 * c.b, -0.25 * c.r + 0.5 * c.g - 0.25 * c.b);
}
vec3 fromPerceived(vec3 p, float exposure) {
  vec3 c = vec3(p.x + p.y - p.z, p.x + p.z, p.x - p.y - p.z);
  c = clamp(c, 0.0, 0.9999);
  return c / (1.0 - max(max(c.r, c.g), c.b)) / exposure;
}

// Sums over a pixel's neighborhood, as toPerceived() gives them.
struct Neighborhood {
  vec3 sum, squares;
  float count;
};

// How far a history lies outside of a neighborhood's spread, in spreads: at most 1 inside.
float strangeness(vec3 history, Neighborhood around, float deviations, out vec3 mean) {
  mean = around.sum / around.count;
  vec3 spread = deviations * sqrt(max(around.squares / around.count - mean * mean, vec3(0.0))) + 1e-4;
  vec3 units = abs((history - mean) / spread);
  return max(max(units.x, units.y), units.z);
}

// Depths of a neighborhood, without those that are 0.
struct DepthRange {
  float low, high;
};
const DepthRange NO_DEPTHS = DepthRange(2.0 * VERY_FAR, 0.0);
DepthRange extended(DepthRange range, float depth) {
  if (depth > 0.0) range = DepthRange(min(range.low, depth), max(range.high, depth));
  return range;
}
// Whether two neighborhoods have no surface in common.
bool apart(DepthRange a, DepthRange b) {
  const float SAME = 1.03;
  return a.high > 0.0 && b.high > 0.0 && (a.low > SAME * b.high || b.low > SAME * a.high);
}
