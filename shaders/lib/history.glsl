// Colors of earlier frames: where to read them and what of them can still be true.
#include "shared/passes/temporal.h"

// Catmull-Rom with five bilinear taps: the corners' small weights are left out. Never negative.
vec3 smoothHistory(sampler2D history, vec2 at) {
  vec2 texel = 1.0 / vec2(textureSize(history, 0));
  vec2 center = floor(at - 0.5) + 0.5, f = at - center;
  vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f)), w1 = 1.0 + f * f * (-2.5 + 1.5 * f);
  vec2 w2 = f * (0.5 + f * (2.0 - 1.5 * f)), w3 = f * f * (-0.5 + 0.5 * f);
  vec2 middle = w1 + w2, between = center + w2 / middle;
  vec4 sum = vec4(textureLod(history, between * texel, 0.0).rgb, 1.0) * (middle.x * middle.y);
  sum += vec4(textureLod(history, vec2(center.x - 1.0, between.y) * texel, 0.0).rgb, 1.0) * (w0.x * middle.y);
  sum += vec4(textureLod(history, vec2(center.x + 2.0, between.y) * texel, 0.0).rgb, 1.0) * (w3.x * middle.y);
  sum += vec4(textureLod(history, vec2(between.x, center.y - 1.0) * texel, 0.0).rgb, 1.0) * (middle.x * w0.y);
  sum += vec4(textureLod(history, vec2(between.x, center.y + 2.0) * texel, 0.0).rgb, 1.0) * (middle.x * w3.y);
  return max(sum.rgb / sum.a, vec3(0.0));
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

// The nearest to `history` on the line to the neighborhood's mean that lies within its spread.
vec3 clipped(vec3 history, Neighborhood around, float deviations) {
  vec3 mean = around.sum / around.count;
  vec3 spread = deviations * sqrt(max(around.squares / around.count - mean * mean, vec3(0.0))) + 1e-4;
  vec3 away = history - mean, units = abs(away / spread);
  float most = max(max(units.x, units.y), units.z);
  return most > 1.0 ? mean + away / most : history;
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
