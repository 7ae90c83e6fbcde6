// Clear surfaces (KHR_materials_transmission) in pictures that blend. With TRANSMISSION, programs that evaluate surfaces
// know them: such a surface reflects and scatters like any other, and what it lets pass is added to what it scatters.
#include "lib/dielectric.glsl"
#include "lib/fresnel.glsl"
#include "lib/surface.glsl"

// A material's share of light that meets a clear inside.
float clearShare(Surface s) { return s.transmission * (1.0 - s.metallic); }

// Takes what it lets pass off a surface, and returns that share by color: of what enters, all that its border does not
// reflect. What is left scatters the rest, and has the f0 with which Schlick's formula says what Fresnel's equations do
// for this direction, or 0 where they say less than it can. `ratio`: index of refraction before the surface over that
// behind it; `byScreen`: the screen answers for what is too rough to be traced, else the sky does.
vec3 takeClear(inout Surface s, vec3 direction, float ratio, bool byScreen) {
  vec3 passing = clearShare(s) * s.baseColor;
  if (clearShare(s) > 0.0) {
    float cosine = -dot(s.normal, direction), grazing = fresnelSchlick(vec3(0.0), cosine).x;
    float reflectance = meetInterface(direction, s.normal, ratio).reflectance;
    vec3 f0 = vec3(clamp((reflectance - grazing) / max(1.0 - grazing, 1e-6), 0.0, 1.0));
    passing *= 1.0 - (byScreen ? fresnelSchlick(f0, cosine)
                               : reflectionShare(f0, s.roughness, cosine) + skyShare(f0, s.roughness, cosine));
    s.f0 = mix(f0, s.baseColor, s.metallic);
    // What is selected by should not fade at grazing angles, where that f0 does.
    float straight = (1.0 - ratio) * (1.0 - ratio) / ((1.0 + ratio) * (1.0 + ratio));
    vec3 selecting = mix(max(f0, vec3(straight)), s.baseColor, s.metallic);
    s.reflectivity = s.unlit ? 0.0 : luminance(selecting) * roughnessFade(s.roughness);
  }
  s.baseColor *= 1.0 - s.transmission;
  return passing;
}
