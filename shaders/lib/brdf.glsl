// glTF 2.0 metallic-roughness (appendix B): GGX, height-correlated Smith, Schlick, Lambert.
#include "lib/fresnel.glsl"
#include "lib/ggx.glsl"
#include "lib/lobes.glsl"
#include "lib/surface.glsl"

const float PI = 3.14159265358979;

// Lights are points: below this width of the lobe their highlights would shrink to nothing or alias.
const float LOWEST_ALPHA = 0.02;

// Reflected radiance for unit irradiance across the light's direction, cosine included. The blend already takes the
// traced share of Fresnel's reflectance away from this, so only the rest is taken from the diffuse lobe here.
vec3 shadeLight(Surface s, vec3 toEye, vec3 toLight) {
  float nl = dot(s.normal, toLight);
  if (nl <= 0.0) return vec3(0.0);
  float nv = max(dot(s.normal, toEye), 1e-4);
  vec3 halfway = normalize(toEye + toLight);
  float nh = clamp(dot(s.normal, halfway), 0.0, 1.0);
  float vh = clamp(dot(toEye, halfway), 0.0, 1.0);

  float alpha = max(s.roughness * s.roughness, LOWEST_ALPHA);
  float a2 = alpha * alpha;
  float d = nh * nh * (a2 - 1.0) + 1.0;
  float distribution = a2 / (PI * d * d);
  float visibility = 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));
  vec3 fresnel = fresnelSchlick(s.f0, vh);

#ifdef LOBES
  if (s.anisotropy > 0.0) {
    mat3 axes = mat3(s.anisotropyDirection, cross(s.normal, s.anisotropyDirection), s.normal);
    vec2 alphas = stretchedAlphas(alpha, s.anisotropy);
    distribution = ggxDistribution(halfway * axes, alphas);
    visibility = ggxMaskingShadowing(vec3((toEye * axes).xy, nv), toLight * axes, alphas) / (4.0 * nv * nl);
  }
#endif
  vec3 diffuse = s.baseColor * ((1.0 - s.metallic) / PI) * (1.0 - fresnel * (1.0 - roughnessFade(s.roughness)));
  vec3 reflected = (diffuse + fresnel * (distribution * visibility)) * nl;
#ifdef LOBES
  reflected *= min(belowSheen(s.sheenColor, s.sheenRoughness, nv), belowSheen(s.sheenColor, s.sheenRoughness, nl));
  reflected += s.sheenColor * (sheenLobe(nh, nv, nl, s.sheenRoughness) * nl);
#endif
  return reflected;
}
