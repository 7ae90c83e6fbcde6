// One of the direct lights as a point sees it if nothing is in the way: for effects that send rays to lights.
#include "lib/lights.glsl"
#include "lib/sampling.glsl"
#include "shared/rays.h"

struct LightSample {
  vec3 toLight;    // unit
  float distance;  // meters; FAR_AWAY: of a directional light
  vec3 light;      // irradiance on a plane that faces the light, or its estimate if the light has an extent
};

// A sphere, by a direction that is chosen evenly from those in which it is seen. Inside there is no light.
LightSample sampleSphere(vec3 toCenter, float radius, vec3 radiance, vec2 numbers) {
  float distance2 = dot(toCenter, toCenter), sine2 = radius * radius / max(distance2, 1e-37);
  if (sine2 >= 1.0) return LightSample(vec3(0.0, 1.0, 0.0), 0.0, vec3(0.0));
  float widest = sine2 / (1.0 + sqrt(1.0 - sine2));  // 1 - the cosine of the outline
  float fall = numbers.x * widest, cosine = 1.0 - fall, angle = 2.0 * PI * numbers.y;
  float sine = sqrt(max(0.0, fall * (2.0 - fall))), away = sqrt(distance2);
  vec3 middle = toCenter / away, x, y;
  frameAround(middle, x, y);
  vec3 direction = normalize(sine * (cos(angle) * x + sin(angle) * y) + cosine * middle);
  float reach = away * cosine - sqrt(max(0.0, radius * radius - distance2 * sine * sine));
  return LightSample(direction, reach, radiance * (2.0 * PI * widest));
}

// `numbers` in [0, 1) choose a point of lights that have an extent.
LightSample sampleLight(uint light, vec3 position, vec2 numbers) {
  vec4 directionType = lightTexel(light, LIGHT_DIRECTION);
  vec3 color = lightTexel(light, LIGHT_COLOR).rgb;
  int type = int(directionType.w);
  if (type == LIGHT_DIRECTIONAL) return LightSample(-directionType.xyz, FAR_AWAY, color);
  vec4 positionRange = lightTexel(light, LIGHT_POSITION), extent = lightTexel(light, LIGHT_EXTENT);
  vec3 toLight = positionRange.xyz - position;
  if (type == LIGHT_SPHERE)
    return sampleSphere(toLight, extent.y, color / extent.z * rangeWindow(positionRange.w, length(toLight)), numbers);
  if (type == LIGHT_RECTANGLE)
    toLight += (2.0 * numbers.x - 1.0) * lightTexel(light, LIGHT_HALF_WIDTH).xyz +
               (2.0 * numbers.y - 1.0) * lightTexel(light, LIGHT_HALF_HEIGHT).xyz;
  float distanceToLight = length(toLight);
  toLight /= max(distanceToLight, 1e-30);
  // A rectangle's radiance is its color over its area, which is the density of its points.
  color *= attenuation(directionType, lightTexel(light, LIGHT_SHADOW), positionRange.w, toLight, distanceToLight);
  return LightSample(toLight, distanceToLight, color);
}

// Hits nearer than that are between the surface and the light.
float distanceBefore(LightSample to) { return to.distance < FAR_AWAY ? 0.9999 * to.distance : FAR_AWAY; }
