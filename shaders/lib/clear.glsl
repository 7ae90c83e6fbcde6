// Clear surfaces (KHR_materials_transmission) in pictures that blend. With TRANSMISSION, programs that evaluate surfaces
// know them: such a surface reflects and scatters like any other, and what it lets pass is added to what it scatters.
#include "lib/dielectric.glsl"
#include "lib/fresnel.glsl"
#include "lib/surface.glsl"

// A material's share of light that meets a clear inside.
float clearShare(Surface s) { return s.transmission * (1.0 - s.metallic); }

// Takes what it lets pass off a surface, and returns the share of what enters, by color. What is left scatters the rest,
// and has the f0 with which Schlick's formula says what Fresnel's equations do for this direction, or 0 where they say
// less than it can. `ratio`: index of refraction before the surface over that behind it.
vec3 takeClear(inout Surface s, vec3 direction, float ratio) {
  vec3 passing = clearShare(s) * s.baseColor;
  if (clearShare(s) > 0.0) {
    float grazing = fresnelSchlick(vec3(0.0), -dot(s.normal, direction)).x;
    float reflectance = meetInterface(direction, s.normal, ratio).reflectance;
    float f0 = clamp((reflectance - grazing) / max(1.0 - grazing, 1e-6), 0.0, 1.0);
    s.f0 = mix(vec3(f0), s.baseColor, s.metallic);
  }
  s.baseColor *= 1.0 - s.transmission;
  return passing;
}
