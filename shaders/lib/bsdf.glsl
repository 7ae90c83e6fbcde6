// How a surface scatters light, without loss: a coat over a base, which is Lambert's diffuse under a GGX specular layer,
// or glass. Layers take what the ones above them leave, by their reflectance as seen from the viewer (albedo scaling);
// what single scattering between microfacets loses is given back by a factor (Turquin 2019), so that a white surface
// in an even light is as bright as that.
//
// With LOBES fibers lie between the coat and the base (lib/lobes.glsl), which are scattered as the diffuse lobe is, and
// the specular layer may be stretched; what its facets lose is that of the root mean square of
// both roughnesses. Glass is not stretched.
//
// Smooth lobes are directions, not densities; those and glass are chosen, never evaluated.
#include "lib/dielectric.glsl"
#include "lib/lobes.glsl"
#include "lib/sampling.glsl"
#include "lib/specular_layer.glsl"
#include "lib/surface.glsl"

const float COAT_F0 = 0.04;

struct Bsdf {
  vec3 x, y;  // the frame of Surface::normal
  vec3 v;     // towards the viewer, in it
  vec3 coatX, coatY, coatV;
  Specular coat, specular;
  float coatShare;   // of the surface
  vec3 diffuse;      // albedo
  float glassShare;  // of what is below the coat
  vec3 tint;         // of what passes through glass
#ifdef LOBES
  vec3 sheen;  // color, where the coat lets it through
  float sheenRoughness;
  float belowSheen;  // what the fibers leave
#endif
  // How often each is chosen.
  float chooseCoat, chooseSpecular, chooseDiffuse, chooseGlass;
};

Bsdf makeBsdf(Surface s, vec3 toEye) {
  Bsdf b;
  frameAround(s.normal, b.x, b.y);
  b.v = vec3(dot(toEye, b.x), dot(toEye, b.y), max(dot(toEye, s.normal), 1e-4));
  frameAround(s.coatNormal, b.coatX, b.coatY);
  b.coatV = vec3(dot(toEye, b.coatX), dot(toEye, b.coatY), max(dot(toEye, s.coatNormal), 1e-4));
  b.coatShare = s.coat;
  b.coat = makeSpecular(vec3(COAT_F0), s.coatRoughness, b.coatV.z);
  b.specular = makeSpecular(s.f0, s.roughness, b.v.z);
  float below = 1.0 - s.coat * b.coat.albedo.x;
#ifdef LOBES
  if (s.anisotropy > 0.0) {
    vec2 alphas = stretchedAlphas(max(s.roughness * s.roughness, 1e-3), s.anisotropy);
    b.x = s.anisotropyDirection;
    b.y = cross(s.normal, b.x);
    b.v.xy = vec2(dot(toEye, b.x), dot(toEye, b.y));
    b.specular = makeSpecular(s.f0, pow(0.5 * dot(alphas, alphas), 0.25), b.v.z);
    b.specular.alpha = s.roughness * s.roughness;
    b.specular.alphas = alphas;
  }
  b.sheen = below * s.sheenColor;
  b.sheenRoughness = s.sheenRoughness;
  b.belowSheen = belowSheen(s.sheenColor, s.sheenRoughness, b.v.z);
  below *= b.belowSheen;
#endif
  b.glassShare = s.transmission * (1.0 - s.metallic);
  b.diffuse = below * (1.0 - s.metallic) * (1.0 - s.transmission) * s.baseColor * (1.0 - b.specular.albedo);
  b.tint = s.baseColor;
  b.chooseCoat = s.coat * b.coat.albedo.x;
  b.chooseSpecular = below * (1.0 - b.glassShare) * max(luminance(b.specular.albedo), 1e-3);
  b.chooseDiffuse = luminance(b.diffuse);
#ifdef LOBES
  b.chooseDiffuse += luminance(b.sheen) * sheenAlbedo(b.v.z, s.sheenRoughness);
#endif
  b.chooseGlass = below * b.glassShare;
  float all = b.chooseCoat + b.chooseSpecular + b.chooseDiffuse + b.chooseGlass;
  b.chooseCoat /= all;
  b.chooseSpecular /= all;
  b.chooseDiffuse /= all;
  b.chooseGlass /= all;
  return b;
}

float belowCoat(Bsdf b) {
  float below = 1.0 - b.coatShare * b.coat.albedo.x;
#ifdef LOBES
  below *= b.belowSheen;
#endif
  return below;
}
vec3 intoCoat(Bsdf b, Surface s, vec3 l) { return vec3(dot(l, b.coatX), dot(l, b.coatY), dot(l, s.coatNormal)); }
vec3 intoBase(Bsdf b, Surface s, vec3 l) { return vec3(dot(l, b.x), dot(l, b.y), dot(l, s.normal)); }

// Of the lobes that have densities, on the viewer's side: reflected radiance per irradiance, times the cosine.
vec3 evaluateBsdf(Bsdf b, Surface s, vec3 toLight, out float density) {
  density = 0.0;
  vec3 value = vec3(0.0);
  if (dot(toLight, s.geometricNormal) <= 0.0) return value;
  vec3 l = intoBase(b, s, toLight), c = intoCoat(b, s, toLight);
  if (c.z > 0.0 && b.coatShare > 0.0 && !smoothSpecular(b.coat)) {
    value += b.coatShare * specularTimesCosine(b.coat, b.coatV, c);
    density += b.chooseCoat * ggxReflectedDensity(ALONG(b.coatV), ALONG(normalize(b.coatV + c)), ALPHA(b.coat));
  }
  if (l.z <= 0.0) return value;
  value += b.diffuse * (l.z / 3.14159265358979);
  density += b.chooseDiffuse * l.z / 3.14159265358979;
#ifdef LOBES
  value += b.sheen * (sheenLobe(normalize(b.v + l).z, b.v.z, l.z, b.sheenRoughness) * l.z);
#endif
  if (!smoothSpecular(b.specular)) {
    value += belowCoat(b) * (1.0 - b.glassShare) * specularTimesCosine(b.specular, b.v, l);
    density += b.chooseSpecular * ggxReflectedDensity(ALONG(b.v), ALONG(normalize(b.v + l)), ALPHA(b.specular));
  }
  return value;
}

struct Scattering {
  vec3 direction;
  vec3 weight;    // of the light that comes from there; 0: none does
  float density;  // 0: there was no choice, or nothing but choosing finds this direction
  bool passes;    // to the far side
};

// Chooses a direction of glass. eta: index of the far side over that of the near one.
Scattering scatterGlass(Bsdf b, Surface s, float eta, vec2 numbers, float choice) {
  float alpha = b.specular.alpha;
  vec3 h = smoothLobe(alpha) ? vec3(0.0, 0.0, 1.0) : ggxVisibleNormal(b.v, alpha, numbers);
  Interface border = meetInterface(-b.v, h, 1.0 / eta);
  bool passes = choice >= border.reflectance;
  vec3 l = reflect(-b.v, h);
  if (passes && s.thin)
    l.z = -l.z;  // in and out again
  else if (passes)
    l = border.refracted;
  vec3 weight = passes ? b.tint : vec3(1.0);
  if (passes == (l.z > 0.0)) weight = vec3(0.0);
  // A thin wall passes the mirror image of what it reflects, so it loses what a reflecting surface does.
  vec2 energy = energyOf(b.v.z, sqrt(alpha), 0.0);
  if (s.thin && !smoothLobe(alpha))
    weight *= ggxMaskingShadowing(b.v.z, abs(l.z), alpha) / (ggxMasking(b.v.z, alpha) * max(energy.x + energy.y, 1e-3));
  else if (!smoothLobe(alpha))
    weight *= ggxMasking(abs(l.z), alpha) / max(boundaryEnergy(b.v.z, sqrt(alpha), eta), 1e-3);
  vec3 direction = normalize(l.x * b.x + l.y * b.y + l.z * s.normal);
  if (passes == (dot(direction, s.geometricNormal) > 0.0)) weight = vec3(0.0);
  return Scattering(direction, weight * belowCoat(b) * b.glassShare / b.chooseGlass, 0.0, passes);
}

// Chooses one. `numbers` for the direction, `choices` among the lobes and of reflection or refraction, each in [0, 1).
Scattering scatter(Bsdf b, Surface s, float eta, vec2 numbers, vec2 choices) {
  float choice = choices.x;
  if (choice < b.chooseGlass) return scatterGlass(b, s, eta, numbers, choices.y);
  choice -= b.chooseGlass;
  bool ofCoat = choice < b.chooseCoat, ofSpecular = !ofCoat && choice < b.chooseCoat + b.chooseSpecular;
  vec3 direction;
  if (!ofCoat && !ofSpecular) {
    direction = cosineDirection(s.normal, numbers);
  } else {
    vec3 v = ofCoat ? b.coatV : b.v, n = ofCoat ? s.coatNormal : s.normal;
    vec3 x = ofCoat ? b.coatX : b.x, y = ofCoat ? b.coatY : b.y;
#ifdef LOBES
    vec2 alpha = ofCoat ? b.coat.alphas : b.specular.alphas;
    bool smoothly = smoothLobe(max(alpha.x, alpha.y));
#else
    float alpha = ofCoat ? b.coat.alpha : b.specular.alpha;
    bool smoothly = smoothLobe(alpha);
#endif
    vec3 h = smoothly ? vec3(0.0, 0.0, 1.0) : ggxVisibleNormal(v, alpha, numbers);
    vec3 l = 2.0 * dot(v, h) * h - v;
    direction = normalize(l.x * x + l.y * y + l.z * n);
    if (smoothly) {
      vec3 weight = ofCoat ? b.coatShare * fresnelSchlick(b.coat.f0, v.z) / b.chooseCoat
                           : belowCoat(b) * (1.0 - b.glassShare) * fresnelSchlick(b.specular.f0, v.z) / b.chooseSpecular;
      // An interpolated normal may mirror to below the triangle.
      if (dot(direction, s.geometricNormal) < 0.0) direction = reflect(direction, s.geometricNormal);
      return Scattering(direction, weight, 0.0, false);
    }
  }
  float density;
  vec3 value = evaluateBsdf(b, s, direction, density);
  return Scattering(direction, density > 0.0 ? value / density : vec3(0.0), density, false);
}
