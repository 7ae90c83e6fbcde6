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
// by how far their surfaces are alike: they reflect nearly the same. Alpha 0 if there are none, or not `wanted`: then the
// loop ends before it begins, which is all that a software rasterizer skips.
vec4 neighbors(ivec2 pixel, vec3 normal, bool wanted) {
  const int REACH = 2, WIDTH = 2 * REACH + 1;  // pixels: finds one if select.fraction is 1/16 or more
  const float ALIKE = 64.0;
  float pixelWidth = coneWidth(drawnDepth(pixel));
  vec3 position = drawnPoint(pixel);
  vec4 sum = vec4(0.0);
  for (int i = wanted ? 0 : WIDTH * WIDTH; i < WIDTH * WIDTH; ++i) {
    ivec2 away = ivec2(i % WIDTH, i / WIDTH) - REACH, other = pixel + away;
    if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, ivec2(frame.width, frame.height)))) continue;
    vec4 traced = texelFetch(gReflection, other, 0), facing = facingAt(other);
    if (traced.a <= 0.0 || goesOn(facing)) continue;
    float cosine = max(dot(normal, facing.xyz), 0.0);
    float offPlane = abs(dot(normal, drawnPoint(other) - position)) / pixelWidth;
    float weight = exp(-0.5 * float(away.x * away.x + away.y * away.y) - offPlane) * pow(cosine, ALIKE);
    sum += weight * vec4(traced.rgb, 1.0);
  }
  return sum.a > 1e-6 ? vec4(sum.rgb / sum.a, 1.0) : vec4(0.0);
}

PixelLight pixelLight(ivec2 pixel) {
  vec4 traced = texelFetch(gReflection, pixel, 0);
  if (frame.allLight != 0u && traced.a > 0.0) return PixelLight(traced.rgb, vec3(0.0));
  vec4 facing = facingAt(pixel);
  Blend blend = blendOf(pixel, facing);
  if (blend.share == vec3(0.0)) return PixelLight(blend.base, vec3(0.0));
  bool wanted = traced.a <= 0.0 && frame.allLight == 0u && frame.fill == FILL_NEIGHBORS;
  vec4 around = neighbors(pixel, facing.xyz, wanted);
  if (wanted) traced = around;
  return PixelLight(blend.base, blend.share * (traced.a > 0.0 ? traced.rgb : blend.sky));
}
