// Colors of earlier frames: where to read them and what of them can still be true.
#include "shared/passes/temporal.h"

// Weights of six neighboring texels for a place that lies `f` after the third: the polynomial through them (Lagrange).
void quintic(float f, out float weights[6]) {
  float a = f + 2.0, b = f + 1.0, c = f - 1.0, d = f - 2.0, e = f - 3.0;
  weights = float[6](-b * f * c * d * e / 120.0, a * f * c * d * e / 24.0, -a * b * c * d * e / 12.0,
                     a * b * f * d * e / 12.0, -a * b * f * c * e / 24.0, a * b * f * c * d / 120.0);
}

// A history is resampled in every frame, so the filter's error adds up over all frames that it holds. A shorter filter
// holds patterns back: of 16 frames at a quarter of a pixel each, stripes of six pixels lag by 0.01 pixel here, by 0.22
// with Catmull-Rom. Never negative.
vec3 smoothHistory(sampler2D history, vec2 at) {
  ivec2 last = textureSize(history, 0) - 1, corner = ivec2(floor(at - 0.5)) - 2;
  vec2 f = fract(at - 0.5);
  float across[6], up[6];
  quintic(f.x, across);
  quintic(f.y, up);
  vec3 sum = vec3(0.0);
  for (int y = 0; y < 6; ++y) {
    vec3 row = vec3(0.0);
    for (int x = 0; x < 6; ++x)
      row += across[x] * texelFetch(history, clamp(corner + ivec2(x, y), ivec2(0), last), 0).rgb;
    sum += up[y] * row;
  }
  return max(sum, vec3(0.0));
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
