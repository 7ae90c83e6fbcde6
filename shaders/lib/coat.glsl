// A clear coat over a surface (KHR_materials_clearcoat), in pictures that blend: two mirrors, one above the other. Rays
// follow the one whose share of the picture is larger, and the sky stands in for the other. With COATS, programs that
// light surfaces know them; light on a coated surface then comes as the picture shows it, and the blend leaves it so.
//
// Of pixels, GBuffer::coat has the mirror that rays do not follow: xy its normal, as folded by octahedral(), and w its
// roughness; z is the coat's share of the surface, negative where it is the coat that they follow, 0 without a coat. The
// other layers have normal and roughness of the mirror that they follow.
#include "lib/brdf.glsl"
#include "lib/octahedral.glsl"

const vec3 FILM_F0 = vec3(0.04);  // of index of refraction 1.5

float filmReflectance(float coat, float cosine) { return coat * fresnelSchlick(FILM_F0, cosine).x; }

// What becomes of light at a surface that may have a coat.
struct CoatBlend {
  bool ofCoat;       // rays follow the coat
  vec3 share;        // of what they find
  vec3 base;         // of light that the base scatters
  float highlights;  // of those in the coat
  vec3 skyInBase;    // of the sky where the two mirrors look
  float skyInCoat;
};

// `ofCoat`: whether rays follow the coat.
CoatBlend coatBlend(Surface s, vec3 toEye, bool ofCoat) {
  float film = filmReflectance(s.coat, dot(s.coatNormal, toEye)), filmFade = roughnessFade(s.coatRoughness);
  float cosine = dot(s.normal, toEye);
  vec3 share = reflectionShare(s.f0, s.roughness, cosine), below = (1.0 - film) * share;
  CoatBlend b;
  b.ofCoat = ofCoat;
  b.share = b.ofCoat ? vec3(film * filmFade) : below;
  b.base = (1.0 - film) * (1.0 - share);
  b.highlights = s.coat * (1.0 - film * filmFade);
  b.skyInBase = (1.0 - film) * skyShare(s.f0, s.roughness, cosine) + (b.ofCoat ? below : vec3(0.0));
  b.skyInCoat = film - (b.ofCoat ? film * filmFade : 0.0);
  return b;
}

bool followsCoat(Surface s, vec3 toEye) {
  float film = filmReflectance(s.coat, dot(s.coatNormal, toEye));
  vec3 below = (1.0 - film) * reflectionShare(s.f0, s.roughness, dot(s.normal, toEye));
  return film * roughnessFade(s.coatRoughness) > luminance(below);
}

CoatBlend coatBlend(Surface s, vec3 toEye) { return coatBlend(s, toEye, followsCoat(s, toEye)); }

// Reflectance of the mirror that rays follow, straight on, and what of it is smooth enough.
float followedReflectivity(Surface s, bool ofCoat) {
  return ofCoat ? s.coat * FILM_F0.x * roughnessFade(s.coatRoughness) : s.reflectivity;
}

// shadeLight() as the picture shows it, with the coat's highlight.
vec3 shadeCoated(Surface s, vec3 toEye, vec3 toLight) {
  if (s.coat <= 0.0) return shadeLight(s, toEye, toLight);
  CoatBlend b = coatBlend(s, toEye);
  Surface film = s;
  film.normal = s.coatNormal;
  film.baseColor = vec3(0.0);
  film.f0 = FILM_F0;
  film.roughness = s.coatRoughness;
#ifdef LOBES
  film.sheenColor = vec3(0.0);
  film.anisotropy = 0.0;
#endif
  return b.base * shadeLight(s, toEye, toLight) + b.highlights * shadeLight(film, toEye, toLight);
}
