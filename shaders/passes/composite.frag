// Blends deferred shading and reflection and brings the result to the display.
#include "lib/fresnel.glsl"
#include "lib/gbuffer.glsl"
#include "lib/sky.glsl"

layout(binding = UNIT_SHADED) uniform sampler2D gShaded;
layout(binding = UNIT_REFLECTION) uniform sampler2D gReflection;

uniform vec2 origin;  // of the target's rectangle

layout(location = 0) out vec4 color;

vec3 blended(ivec2 pixel) {
  vec4 shaded = texelFetch(gShaded, pixel, 0);
  vec4 position = texelFetch(gPosition, pixel, 0);
  vec4 material = texelFetch(gMaterial, pixel, 0);
  bool unlit = material.a < 0.0;
  if (position.w <= 0.0 || unlit) return shaded.rgb;
  vec3 normal = texelFetch(gNormal, pixel, 0).xyz;
  vec4 traced = texelFetch(gReflection, pixel, 0);
  vec3 direction = normalize(position.xyz - frame.eye.xyz);
  float cosine = -dot(normal, direction);
  vec3 share = reflectionShare(material.rgb, material.a, cosine);
  vec3 sky = skyRadiance(reflect(direction, normal), material.a) * shaded.a;
  vec3 reflection = traced.a > 0.0 ? traced.rgb : sky;
  return (1.0 - share) * shaded.rgb + share * reflection + skyShare(material.rgb, material.a, cosine) * sky;
}

#ifndef LINEAR
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

// Ordered 8 x 8 dither, -0.5..0.5: the bits of x xor y and of y, interleaved from the lowest.
float dither(ivec2 pixel) {
  int mixed = pixel.x ^ pixel.y;
  int value = 0;
  for (int bit = 0; bit < 3; ++bit) value = (value << 2) | (((mixed >> bit) & 1) << 1) | ((pixel.y >> bit) & 1);
  return (float(value) + 0.5) / 64.0 - 0.5;
}
#endif

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy - origin);
  vec3 radiance = blended(pixel);
#ifdef LINEAR
  color = vec4(radiance, 1.0);
#else
  radiance = max(radiance * frame.exposure, vec3(0.0));
  vec3 display = encodeSrgb(clamp(frame.toneMap == 0u ? filmic(radiance) : radiance, 0.0, 1.0));
  // Black and white stay exact.
  vec3 room = min(min(display, 1.0 - display) * 255.0, 1.0);
  color = vec4(display + dither(pixel) / 255.0 * room, 1.0);
#endif
}
