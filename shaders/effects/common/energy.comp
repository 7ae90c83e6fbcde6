// How much light rough surfaces reflect once, and how much rough boundaries pass on: what the microfacet model loses
// between facets is given back by this (lib/bsdf.glsl). One invocation per texel.
#include "lib/dielectric.glsl"
#include "lib/ggx.glsl"
#include "lib/random.glsl"
#include "shared/passes/energy.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = IMAGE_ENERGY, rg32f) uniform writeonly image3D energy;

const uint SAMPLES = 512u;

void main() {
  uvec3 texel = gl_GlobalInvocationID;
  float vz = max(float(texel.x) / float(ENERGY_SIZE - 1), 0.5 / float(ENERGY_SIZE - 1));
  float roughness = float(texel.y) / float(ENERGY_SIZE - 1);
  float alpha = max(roughness * roughness, 1e-4);
  vec3 v = vec3(sqrt(1.0 - vz * vz), 0.0, vz);
  vec2 sum = vec2(0.0);
  for (uint i = 0u; i < SAMPLES; ++i) {
    vec2 numbers = sample2(texel.z, i, 0u);
    vec3 h = ggxVisibleNormal(v, alpha, numbers);
    float vh = dot(v, h);
    vec3 l = 2.0 * vh * h - v;
    if (texel.z == 0u) {
      // Reflectance is f0 x + y with Schlick's Fresnel (Karis 2013).
      if (l.z <= 0.0) continue;
      float part = ggxMaskingShadowing(vz, l.z, alpha) / ggxMasking(vz, alpha), x = 1.0 - vh;
      float fresnel = x * x * x * x * x;
      sum += part * vec2(1.0 - fresnel, fresnel);
    } else {
      float eta = exp2(ENERGY_ETA_OCTAVES * (2.0 * float(texel.z - 1u) / float(ENERGY_ETAS - 1) - 1.0));
      Interface border = meetInterface(-v, h, 1.0 / eta);
      if (l.z > 0.0) sum.x += border.reflectance * ggxMasking(l.z, alpha);
      if (border.refracted.z < 0.0) sum.x += (1.0 - border.reflectance) * ggxMasking(-border.refracted.z, alpha);
    }
  }
  imageStore(energy, ivec3(texel), vec4(sum / float(SAMPLES), 0.0, 0.0));
}
