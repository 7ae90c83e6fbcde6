#include "lib/frame.glsl"
#include "lib/light_list.glsl"

// Light that comes without shadows, dimmed where little of the sky is seen.
vec3 bouncedIrradiance(vec3 normal, float visibility) {
  uint first = frame.directLights + frame.skyDirections;
  vec3 steady = vec3(0.0), open = vec3(0.0);
  for (uint i = first; i < first + frame.hemispheres; ++i) {
    vec3 irradiance = lightTexel(i, LIGHT_COLOR).rgb * (0.5 - 0.5 * dot(normal, lightTexel(i, LIGHT_DIRECTION).xyz));
    float steadyShare = lightTexel(i, LIGHT_HEMISPHERE).x;
    steady += irradiance * steadyShare;
    open += irradiance * (1.0 - steadyShare);
  }
  return steady + open * visibility;
}
