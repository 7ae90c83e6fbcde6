// How much of a pixel is reflection: the shares that the blend gives to traced rays and to the sky.
#include "lib/frame.glsl"

// Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering".
vec3 fresnelSchlick(vec3 f0, float cosine) {
  float x = 1.0 - clamp(cosine, 0.0, 1.0);
  float x2 = x * x;
  return f0 + (1.0 - f0) * (x2 * x2 * x);
}

// 1 at roughness 0, 0 from select.max_roughness on.
float roughnessFade(float roughness) {
  if (frame.maxRoughness <= 0.0) return roughness <= 0.0 ? 1.0 : 0.0;
  return clamp(1.0 - roughness / frame.maxRoughness, 0.0, 1.0);
}

// Share of the traced reflection.
vec3 reflectionShare(vec3 f0, float roughness, float cosine) {
  return fresnelSchlick(f0, cosine) * roughnessFade(roughness);
}

// Share of the sky's reflection in what is too rough to be traced. A rough surface's grazing reflectance stays below
// one: the facets that it sees are not at grazing angles (the upper bound follows Lagarde 2011).
vec3 skyShare(vec3 f0, float roughness, float cosine) {
  vec3 f90 = max(vec3(1.0 - roughness), f0);
  float x = 1.0 - clamp(cosine, 0.0, 1.0);
  float x2 = x * x;
  return (f0 + (f90 - f0) * (x2 * x2 * x)) * (1.0 - roughnessFade(roughness));
}
