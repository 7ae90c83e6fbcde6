// What a surface sends on.
#include "effects/common/send_through.glsl"
#include "lib/light_sample.glsl"
#include "lib/random.glsl"
#ifdef SHADOW_MARKS
#include "lib/shadow_marks.glsl"
#endif

uniform uint pass;
uniform uint endsHere;  // what this surface reflects and lets pass is not traced: the sky stands in

// Light that arrives along a reflected ray. `visibility`: of the sky.
void sendReflected(Meeting m, vec3 normal, uint way, vec3 throughput, bool traced, float roughness, float visibility) {
  if (all(lessThanEqual(throughput, vec3(0.0)))) return;
  vec3 direction = directionBefore(m, normal);
  if (traced && endsHere == 0u)
    sendRay(m, RAY_REFLECTION, way, direction, FAR_AWAY, throughput, m.before);
  else
    addLight(m.pixel, throughput * skyRadiance(direction, roughness) * visibility);
}

// All that a clear surface lets pass, of `throughput`; returns the share that it reflects. Colors go ways of their own
// if they are bent differently.
vec3 sendRefracted(Meeting m, vec3 throughput, float visibility) {
  bvec3 carried = greaterThan(m.throughput, vec3(0.0));
  bool single = int(carried.r) + int(carried.g) + int(carried.b) == 1;
  bool spread = !single && !m.s.thin && indexRatio(m, 0) != indexRatio(m, 2);
  vec3 reflectance = vec3(0.0);
  for (int i = 0; i < (spread ? 3 : 1); ++i) {
    int color = spread ? i : single ? (carried.r ? 0 : carried.g ? 1 : 2) : 1;
    vec3 colors = spread ? vec3(equal(ivec3(0, 1, 2), ivec3(i))) : vec3(1.0);
    float ratio = indexRatio(m, color);
    Interface border = meetInterface(m.direction, m.s.normal, ratio);
    reflectance += colors * border.reflectance;
    vec3 passing = throughput * colors * (1.0 - border.reflectance);
    if (all(lessThanEqual(passing, vec3(0.0)))) continue;
    vec3 direction = directionBehind(m, border, ratio);
    if (endsHere != 0u)
      addLight(m.pixel, passing * skyRadiance(direction, m.s.roughness) * visibility);
    else
      sendRay(m, RAY_REFRACTION, WAY_THROUGH + uint(i), direction, FAR_AWAY, passing, m.behind);
  }
  return reflectance;
}

// One ray to each light that is not behind the surface. `base`, `coat`: what is left of light that the base and the
// coat scatter towards the ray's origin.
void sendToLights(Meeting m, vec3 base, float coat) {
  Surface film = m.s;
  film.normal = m.s.coatNormal;
  film.baseColor = vec3(0.0);
  film.f0 = vec3(0.04);
  film.metallic = 0.0;
  film.roughness = m.s.coatRoughness;
#ifdef LOBES
  leaveOutLobes(film);
#endif
  for (uint light = 0u; light < frame.directLights; ++light) {
    LightSample to = sampleLight(light, m.s.position, sample2(m.pixel, pass, joined(m.path, light)));
    if (dot(m.s.geometricNormal, to.toLight) <= 0.0) continue;
    vec3 scattered = base * shadeLight(m.s, -m.direction, to.toLight);
    if (coat > 0.0) scattered += coat * shadeLight(film, -m.direction, to.toLight);
    vec3 throughput = m.throughput * scattered * to.light;
    if (all(lessThanEqual(throughput, vec3(0.0)))) continue;
#ifdef SHADOW_MARKS
    // What the shadow maps are certain of needs no ray; a coat has a normal that they do not know.
    ivec2 pixel = ivec2(m.pixel % frame.width, m.pixel / frame.width);
    if (coat <= 0.0 && !isMarked(pixel, light)) {
      if (isLit(pixel, light)) addLight(m.pixel, throughput);
      continue;
    }
#endif
    sendRay(m, RAY_SHADOW, WAY_TO_LIGHT, to.toLight, distanceBefore(to), throughput, m.before);
  }
}

// Its alpha's share of the light comes from a surface that blends, and the rest from behind it.
void passOn(inout Meeting m) {
  if (frame.blends == 0u || m.s.alpha >= 1.0) return;
  sendRay(m, RAY_THROUGH, WAY_BEHIND, m.direction, FAR_AWAY, m.throughput * (1.0 - m.s.alpha), m.before);
  m.throughput *= m.s.alpha;
}

void shadeMeeting(Meeting m) {
  float clear = clearShare(m.s);
  vec3 tint = m.s.baseColor;
  m.s.baseColor *= 1.0 - m.s.transmission;  // what is not let pass is scattered back
  vec4 ambient = ambientLighting(m.s, -m.direction);
  float film = coatReflectance(m), filmFade = roughnessFade(m.s.coatRoughness);
  if (film > 0.0) {
    vec3 share = m.throughput * film;
    sendReflected(m, m.s.coatNormal, WAY_COAT, share * filmFade, true, m.s.coatRoughness, ambient.a);
    sendReflected(m, m.s.coatNormal, WAY_COAT, share * (1.0 - filmFade), false, m.s.coatRoughness, ambient.a);
  }
  vec3 below = m.throughput * (1.0 - film);

  float cosine = -dot(m.s.normal, m.direction);
  vec3 share = reflectionShare(m.s.f0, m.s.roughness, cosine), skys = skyShare(m.s.f0, m.s.roughness, cosine);
  bool traced = m.s.reflectivity > frame.minReflectivity;
  if (clear > 0.0) {
    vec3 reflectance = sendRefracted(m, below * clear * tint, ambient.a);
    vec3 all = mix(reflectance, fresnelSchlick(tint, cosine), m.s.metallic);
    float fade = roughnessFade(m.s.roughness);
    share = all * fade;
    skys = all * (1.0 - fade);
    traced = true;
  }
  sendReflected(m, m.s.normal, WAY_REFLECTED, below * share, traced, m.s.roughness, ambient.a);
  sendReflected(m, m.s.normal, WAY_REFLECTED, below * skys, false, m.s.roughness, ambient.a);
  addLight(m.pixel, below * (1.0 - share) * (m.s.emissive + ambient.rgb));
  sendToLights(m, (1.0 - film) * (1.0 - share), underCoat(m) ? m.s.coat * (1.0 - film * filmFade) : 0.0);
}
