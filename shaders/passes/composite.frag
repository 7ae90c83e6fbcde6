// Blends deferred shading and reflection and brings the result to the display.
#include "lib/blend.glsl"
#include "lib/display.glsl"

layout(binding = UNIT_REFLECTION) uniform sampler2D gReflection;

uniform vec2 origin;  // of the target's rectangle

layout(location = 0) out vec4 color;

// A pixel that reflects and was not traced takes the reflection of the traced ones around it, weighted by distance and
// by how far their surfaces are alike: they reflect nearly the same. Alpha 0 if there are none.
vec4 neighbors(ivec2 pixel, vec4 position, vec3 normal) {
  const int REACH = 2;  // pixels: finds one if select.fraction is 1/16 or more
  const float ALIKE = 64.0;
  float pixelWidth = position.w * frame.pixelCone;
  vec4 sum = vec4(0.0);
  for (int y = -REACH; y <= REACH; ++y)
    for (int x = -REACH; x <= REACH; ++x) {
      ivec2 other = pixel + ivec2(x, y);
      if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, ivec2(frame.width, frame.height)))) continue;
      vec4 traced = texelFetch(gReflection, other, 0);
      if (traced.a <= 0.0) continue;
      float cosine = max(dot(normal, texelFetch(gNormal, other, 0).xyz), 0.0);
      float offPlane = abs(dot(normal, texelFetch(gPosition, other, 0).xyz - position.xyz)) / pixelWidth;
      float weight = exp(-0.5 * float(x * x + y * y) - offPlane) * pow(cosine, ALIKE);
      sum += weight * vec4(traced.rgb, 1.0);
    }
  return sum.a > 1e-6 ? vec4(sum.rgb / sum.a, 1.0) : vec4(0.0);
}

vec3 blended(ivec2 pixel) {
  vec4 position = texelFetch(gPosition, pixel, 0);
  vec3 normal = texelFetch(gNormal, pixel, 0).xyz;
  Blend blend = blendOf(pixel, position, normal);
  if (blend.share == vec3(0.0)) return blend.base;
  vec4 traced = texelFetch(gReflection, pixel, 0);
  if (traced.a <= 0.0 && frame.fill == FILL_NEIGHBORS) traced = neighbors(pixel, position, normal);
  return blend.base + blend.share * (traced.a > 0.0 ? traced.rgb : blend.sky);
}

#ifndef LINEAR
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
  vec3 display = displayed(radiance);
  // Black and white stay exact.
  vec3 room = min(min(display, 1.0 - display) * 255.0, 1.0);
  color = vec4(display + dither(pixel) / 255.0 * room, 1.0);
#endif
}
