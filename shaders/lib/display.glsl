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

// Ordered 8 x 8 dither, -0.5..0.5: the bits of x xor y and of y, interleaved from the lowest.
float dither(ivec2 pixel) {
  int mixed = pixel.x ^ pixel.y;
  int value = 0;
  for (int bit = 0; bit < 3; ++bit) value = (value << 2) | (((mixed >> bit) & 1) << 1) | ((pixel.y >> bit) & 1);
  return (float(value) + 0.5) / 64.0 - 0.5;
}

// A display value, 0..1, for 8 bits at a pixel of the picture. Black and white stay exact.
vec3 dithered(vec3 display, ivec2 pixel) {
  vec3 room = min(min(display, 1.0 - display) * 255.0, 1.0);
  return display + dither(pixel) / 255.0 * room;
}
