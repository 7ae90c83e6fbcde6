// The gradient sky, the same on the CPU (which integrates it into lights) and in shaders.
#ifndef HALFSILVER_SKY_H
#define HALFSILVER_SKY_H

#ifdef __cplusplus
#define SHARED_FUNCTION inline
#else
#define SHARED_FUNCTION
#endif

// Radiance from a direction with vertical component `up` (-1..1). Roughness (0..1) widens the horizon, as a rough
// surface's lobe would see it.
SHARED_FUNCTION vec3 skyGradient(vec3 zenith, vec3 horizon, vec3 ground, float up, float roughness) {
  float blur = 0.7f * roughness;
  float height = mix(clamp(up, 0.0f, 1.0f), 0.5f, 0.5f * roughness * roughness);
  vec3 above = mix(horizon, zenith, height * (2.0f - height));
  return mix(above, ground, smoothstep(-blur, blur + 0.05f, -up));
}

#endif
