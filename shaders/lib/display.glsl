// From radiance to the display.
#include "lib/frame.glsl"

// A little contrast around PIVOT, channel by channel; above it an exponential shoulder that begins with slope 1 and
// ends at white. The shoulder works on the largest component and keeps the ratios, so hues do not turn; what it
// compresses fades towards white instead.
const float PIVOT = 0.3;
const float CONTRAST = 1.12;
vec3 filmic(vec3 radiance) {
  radiance = PIVOT * pow(radiance / PIVOT, vec3(CONTRAST));
  float peak = max(max(radiance.r, radiance.g), radiance.b);
  if (peak <= PIVOT) return radiance;
  float mapped = 1.0 - (1.0 - PIVOT) * exp(-(peak - PIVOT) / (1.0 - PIVOT));
  float whiteness = 1.0 - 1.0 / (1.0 + 0.15 * (peak - mapped));
  return mix(radiance * (mapped / peak), vec3(mapped), whiteness);
}

vec3 encodeSrgb(vec3 linear) {
  return mix(12.92 * linear, 1.055 * pow(max(linear, 1e-8), vec3(1.0 / 2.4)) - 0.055, greaterThan(linear, vec3(0.0031308)));
}

// 0..1, sRGB-encoded.
vec3 displayed(vec3 radiance) {
  radiance = max(radiance * frame.exposure, vec3(0.0));
  return encodeSrgb(clamp(frame.toneMap == 0u ? filmic(radiance) : radiance, 0.0, 1.0));
}
