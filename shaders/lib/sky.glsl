// Radiance from outside the scene.
#include "shared/sky.h"
#include "lib/frame.glsl"

layout(binding = UNIT_SKY) uniform sampler2D skyImage;  // equirectangular, first row up, mipmapped

// `direction` is unit and points away from the surface; roughness widens the lobe.
vec3 skyRadiance(vec3 direction, float roughness) {
  if (frame.skyIsImage == 0u)
    return skyGradient(frame.skyZenith, frame.skyHorizon, frame.skyGround, direction.y, roughness);
  const float pi = 3.14159265358979;
  vec2 uv = vec2(0.5 + atan(direction.x, -direction.z) / (2.0 * pi), acos(clamp(direction.y, -1.0, 1.0)) / pi);
  // A GGX lobe of width alpha covers about a third of alpha of the full circle.
  float texels = float(textureSize(skyImage, 0).x) * 0.33 * roughness * roughness;
  return textureLod(skyImage, uv, log2(1.0 + texels)).rgb * frame.skyIntensity;
}
