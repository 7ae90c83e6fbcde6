// Where a glossy surface's visible microfacets mirror, as often as they face that way (Heitz 2018).
#include "lib/fresnel.glsl"
#include "lib/ggx.glsl"
#include "lib/sampling.glsl"

struct Lobe {
  vec3 f0;
  vec3 facing;  // reflectance straight at the normal, which the blend scales what is found by
  float alpha;
  vec3 x, y, normal;
  vec3 v;  // towards the eye, in that frame
};

Lobe lobeOf(vec3 f0, float roughness, vec3 normal, vec3 toEye) {
  Lobe lobe;
  lobe.f0 = f0;
  lobe.alpha = roughness * roughness;
  lobe.normal = normal;
  frameAround(normal, lobe.x, lobe.y);
  lobe.v = vec3(dot(toEye, lobe.x), dot(toEye, lobe.y), max(dot(toEye, normal), 1e-4));
  lobe.facing = fresnelSchlick(f0, lobe.v.z);
  return lobe;
}

// The share of a direction in the mean, and the direction. What would leave into the surface brings nothing, and is
// sent the other way.
vec3 sampleLobe(Lobe lobe, vec2 numbers, out vec3 direction) {
  vec3 h = ggxVisibleNormal(lobe.v, lobe.alpha, numbers);
  vec3 l = reflect(-lobe.v, h);
  direction = normalize(l.x * lobe.x + l.y * lobe.y + abs(l.z) * lobe.normal);
  return fresnelSchlick(lobe.f0, dot(lobe.v, h)) / max(lobe.facing, vec3(1e-4)) *
         (l.z > 0.0 ? ggxMaskingShadowing(lobe.v.z, l.z, lobe.alpha) / ggxMasking(lobe.v.z, lobe.alpha) : 0.0);
}
