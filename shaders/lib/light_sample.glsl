// One of the direct lights as a point sees it if nothing is in the way: for effects that send rays to lights.
#include "lib/lights.glsl"
#include "shared/rays.h"

struct LightSample {
  vec3 toLight;    // unit
  float distance;  // meters; FAR_AWAY: of a directional light
  vec3 light;      // irradiance on a plane that faces the light, or its estimate if the light has an extent
};

// `numbers` in [0, 1) choose a point of lights that have an extent.
LightSample sampleLight(uint light, vec3 position, vec2 numbers) {
  vec4 directionType = lightTexel(light, LIGHT_DIRECTION);
  vec3 color = lightTexel(light, LIGHT_COLOR).rgb;
  if (int(directionType.w) == LIGHT_DIRECTIONAL) return LightSample(-directionType.xyz, FAR_AWAY, color);
  vec4 positionRange = lightTexel(light, LIGHT_POSITION);
  vec3 toLight = positionRange.xyz - position;
  float distanceToLight = length(toLight);
  toLight /= max(distanceToLight, 1e-20);
  color *= attenuation(directionType, lightTexel(light, LIGHT_SHADOW), positionRange.w, toLight, distanceToLight);
  return LightSample(toLight, distanceToLight, color);
}
