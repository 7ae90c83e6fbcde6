// A layer of microfacets that mirror, without the loss of single scattering between them: what that loses is given back
// by a factor (Turquin 2019). With LOBES it may be stretched.
#include "lib/fresnel.glsl"
#include "lib/ggx.glsl"
#include "shared/passes/energy.h"

layout(binding = UNIT_ENERGY) uniform sampler3D energyTable;

vec2 energyOf(float cosine, float roughness, float slice) {
  vec2 place = (0.5 + vec2(cosine, roughness) * float(ENERGY_SIZE - 1)) / float(ENERGY_SIZE);
  return textureLod(energyTable, vec3(place, (slice + 0.5) / float(ENERGY_ETAS + 1)), 0.0).xy;
}

float boundaryEnergy(float cosine, float roughness, float eta) {
  float slice = 1.0 + float(ENERGY_ETAS - 1) * clamp(0.5 + 0.5 * log2(eta) / ENERGY_ETA_OCTAVES, 0.0, 1.0);
  return energyOf(cosine, roughness, slice).x;
}

// A specular layer seen at a cosine.
struct Specular {
  vec3 f0;
  float alpha;
#ifdef LOBES
  vec2 alphas;
#endif
  vec3 scale;   // what scattering between facets gives back
  vec3 albedo;  // reflected of all that arrives
};

Specular makeSpecular(vec3 f0, float roughness, float cosine) {
  vec2 energy = energyOf(cosine, roughness, 0.0);
  vec3 scale = 1.0 + f0 * (1.0 / max(energy.x + energy.y, 1e-3) - 1.0);
  vec3 albedo = min(scale * (f0 * energy.x + energy.y), vec3(1.0));
#ifdef LOBES
  return Specular(f0, roughness * roughness, vec2(roughness * roughness), scale, albedo);
#else
  return Specular(f0, roughness * roughness, scale, albedo);
#endif
}

// A lobe's part in the names below: both axes of one that may be stretched.
#ifdef LOBES
#define ALPHA(specular) specular.alphas
#define ALONG(direction) direction
#else
#define ALPHA(specular) specular.alpha
#define ALONG(direction) direction.z
#endif

bool smoothSpecular(Specular specular) {
#ifdef LOBES
  return smoothLobe(max(specular.alphas.x, specular.alphas.y));
#else
  return smoothLobe(specular.alpha);
#endif
}

// Reflected radiance per irradiance, times the cosine; z of both is positive.
vec3 specularTimesCosine(Specular specular, vec3 v, vec3 l) {
  vec3 h = normalize(v + l);
  float d = ggxDistribution(ALONG(h), ALPHA(specular));
  float g = ggxMaskingShadowing(ALONG(v), ALONG(l), ALPHA(specular));
  return specular.scale * fresnelSchlick(specular.f0, dot(v, h)) * (d * g / (4.0 * v.z));
}
