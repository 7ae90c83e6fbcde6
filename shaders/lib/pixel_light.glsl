// The light of a pixel: deferred shading and reflection, blended.
#define WITH_SEEN
#include "lib/blend.glsl"

layout(binding = UNIT_REFLECTION) uniform sampler2D gReflection;

// Radiance towards the eye.
struct PixelLight {
  vec3 surface;
  vec3 reflected;  // of what was traced or stands in for it
};

// A pixel that reflects and was not traced takes the reflection of the traced ones around it, weighted by distance and
// by how far their surfaces are alike: they reflect nearly the same. Alpha 0 if there are none.
vec4 neighbors(ivec2 pixel, vec4 position, vec3 normal) {
  const int REACH = 2;  // pixels: finds one if select.fraction is 1/16 or more
  const float ALIKE = 64.0;
  float pixelWidth = coneWidth(position.w);
  vec4 sum = vec4(0.0);
  for (int y = -REACH; y <= REACH; ++y)
    for (int x = -REACH; x <= REACH; ++x) {
      ivec2 other = pixel + ivec2(x, y);
      if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, ivec2(frame.width, frame.height)))) continue;
      vec4 traced = texelFetch(gReflection, other, 0), facing = texelFetch(gNormal, other, 0);
      if (traced.a <= 0.0 || goesOn(facing)) continue;
      float cosine = max(dot(normal, facing.xyz), 0.0);
      float offPlane = abs(dot(normal, texelFetch(gPosition, other, 0).xyz - position.xyz)) / pixelWidth;
      float weight = exp(-0.5 * float(x * x + y * y) - offPlane) * pow(cosine, ALIKE);
      sum += weight * vec4(traced.rgb, 1.0);
    }
  return sum.a > 1e-6 ? vec4(sum.rgb / sum.a, 1.0) : vec4(0.0);
}

PixelLight pixelLight(ivec2 pixel) {
  vec4 traced = texelFetch(gReflection, pixel, 0);
  if (frame.allLight != 0u && traced.a > 0.0) return PixelLight(traced.rgb, vec3(0.0));
  vec4 position = texelFetch(gPosition, pixel, 0);
  vec4 facing = texelFetch(gNormal, pixel, 0);
  Blend blend = blendOf(pixel, position, facing);
  if (blend.share == vec3(0.0)) return PixelLight(blend.base, vec3(0.0));
  if (traced.a <= 0.0 && frame.allLight == 0u && frame.fill == FILL_NEIGHBORS) traced = neighbors(pixel, position, facing.xyz);
  return PixelLight(blend.base, blend.share * (traced.a > 0.0 ? traced.rgb : blend.sky));
}
