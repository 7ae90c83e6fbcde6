// All light that reaches a surface without a traced reflection. Deferred pixels and traced hits share it.
//
// A kind of light is a range of the list with a loop of its own: first what a light can do at most is found for all of
// the range, then those that can light the surface are worked off, so that neighbors with few of them are done early.
#include "lib/bounced_light.glsl"
#include "lib/brdf.glsl"
#include "lib/coat.glsl"
#include "lib/shadow_maps.glsl"

// Bits of a mask of lights.
const uint LIGHTS_AT_ONCE = 32u;

// Takes the lowest light out of a mask that is not empty.
uint takeLight(inout uint pending) {
  uint light = uint(findLSB(pending));
  pending &= pending - 1u;
  return light;
}

// 1 near the light, 0 from its range on; a range of 0 has no end (KHR_lights_punctual).
float rangeWindow(float range, float distanceToLight) {
  if (range <= 0.0) return 1.0;
  float x = distanceToLight / range;
  return clamp(1.0 - x * x * x * x, 0.0, 1.0);
}

// Inverse square with a range window and the spot's cone, or a rectangle's cosine.
float attenuation(vec4 directionType, vec4 shadow, float range, vec3 toLight, float distanceToLight) {
  float window = rangeWindow(range, distanceToLight);
  float cone = 1.0;
  bool spot = int(directionType.w) == LIGHT_SPOT;
  if (spot || int(directionType.w) == LIGHT_RECTANGLE) {
    float cosine = dot(directionType.xyz, -toLight);
    cone = clamp(cosine * shadow.x + shadow.y, 0.0, 1.0);
  }
  return window * cone * (spot ? cone : 1.0) / max(distanceToLight * distanceToLight, 1e-37);
}

// Whether the surface lies in the light's range and faces it.
bool mayLight(uint light, Surface s) {
  vec4 positionRange = lightTexel(light, LIGHT_POSITION);
  vec4 directionType = lightTexel(light, LIGHT_DIRECTION);
  bool positional = int(directionType.w) != LIGHT_DIRECTIONAL;
  vec3 toLight = positional ? positionRange.xyz - s.position : -directionType.xyz;
  float range = positional ? positionRange.w : 0.0;
  bool reaches = range <= 0.0 || dot(toLight, toLight) < range * range;
  bool faces = dot(s.normal, toLight) > 0.0;
#ifdef COATS
  faces = faces || s.coat > 0.0 && dot(s.coatNormal, toLight) > 0.0;
#endif
  return reaches && faces && dot(s.geometricNormal, toLight) > 0.0;
}

// Reflected radiance for unit irradiance across the light's direction, cosine included.
vec3 shadeBy(Surface s, vec3 toEye, vec3 toLight) {
#ifdef COATS
  return shadeCoated(s, toEye, toLight);
#else
  return shadeLight(s, toEye, toLight);
#endif
}

// A direct light as a surface sees it.
struct ReachedBy {
  vec3 toLight;  // unit
  vec3 color;    // without what is hidden
  float lit;     // the share that the shadow map lets through, 0..1
};

// Of a directional light or of one with a place. They share the look at the shadow map, which is most of it.
ReachedBy reachedBy(uint light, Surface s) {
  vec4 directionType = lightTexel(light, LIGHT_DIRECTION);
  vec4 colorTexel = lightTexel(light, LIGHT_COLOR);
  vec4 shadow = lightTexel(light, LIGHT_SHADOW);
  bool positional = int(directionType.w) != LIGHT_DIRECTIONAL;
  vec3 color = colorTexel.rgb;
  vec3 toLight = -directionType.xyz;
  vec3 receiver = s.position;
  int face = 0;
  if (positional) {
    vec4 positionRange = lightTexel(light, LIGHT_POSITION);
    toLight = positionRange.xyz - s.position;
    float distanceToLight = length(toLight);
    toLight /= max(distanceToLight, 1e-30);
    color *= attenuation(directionType, shadow, positionRange.w, toLight, distanceToLight);
    receiver = liftedReceiver(s.position, s.geometricNormal, toLight, distanceToLight, colorTexel.w);
    if (shadow.w > 1.0) face = cubeFace(receiver - positionRange.xyz);
  } else if (shadow.w > 1.0) {
    face = nestedLayer(light, receiver, int(shadow.w));
  }
  mat4 worldToMap = shadowMatrix(light, face);
  vec4 place = worldToMap * vec4(receiver, 1.0);
  vec2 gradient = positional ? vec2(0.0) : planeGradient(worldToMap, s.geometricNormal);
  if (!positional && isWarped(worldToMap)) gradient = warpedGradient(worldToMap, place, s.geometricNormal);
  float lit = sharpShadow(place.xyz / place.w, shadow.z + float(face), gradient);
  if (shadow.z < 0.0 || place.w <= 0.0) lit = 1.0;
  return ReachedBy(toLight, color, lit);
}

vec3 directLight(uint light, Surface s, vec3 toEye) {
  ReachedBy by = reachedBy(light, s);
  return by.lit > 0.0 ? by.color * by.lit * shadeBy(s, toEye, by.toLight) : vec3(0.0);
}

vec3 directRadiance(Surface s, vec3 toEye) {
  vec3 radiance = vec3(0.0);
  for (uint first = 0u; first < frame.mappedLights; first += LIGHTS_AT_ONCE) {
    uint count = min(frame.mappedLights - first, LIGHTS_AT_ONCE);
    uint pending = 0u;
    for (uint i = 0u; i < count; ++i)
      if (mayLight(first + i, s)) pending |= 1u << i;
    while (pending != 0u) radiance += directLight(first + takeLight(pending), s, toEye);
  }
  return radiance;
}

struct SkyPart {
  vec3 irradiance;   // of the upper sky
  float visibility;  // share of the sky's light that reaches the surface, 0..1
};

SkyPart skyPart(Surface s) {
  uint first = frame.directLights;
  float all = 0.0, facing = 0.0;
  uint pending = 0u;  // there are at most LIGHTS_AT_ONCE directions
  for (uint i = 0u; i < frame.skyDirections; ++i) {
    vec3 direction = lightTexel(first + i, LIGHT_DIRECTION).xyz;
    float weight = luminance(lightTexel(first + i, LIGHT_COLOR).rgb), nl = -dot(s.normal, direction);
    all += weight;
    facing += weight * max(nl, 0.0);
    if (nl > 0.0 && dot(s.geometricNormal, direction) < 0.0) pending |= 1u << i;
  }
  vec3 irradiance = vec3(0.0);
  float seen = 0.0;
  while (pending != 0u) {
    uint light = first + takeLight(pending);
    vec3 color = lightTexel(light, LIGHT_COLOR).rgb;
    float nl = -dot(s.normal, lightTexel(light, LIGHT_DIRECTION).xyz);
    mat4 worldToMap = shadowMatrix(light, 0);
    vec3 place = (worldToMap * vec4(s.position, 1.0)).xyz;
    float lit = softShadow(place, lightTexel(light, LIGHT_SHADOW).z, planeGradient(worldToMap, s.geometricNormal));
    seen += luminance(color) * nl * lit;
    irradiance += color * (nl * lit);
  }
  // A surface that looks down faces no part of the sky: half open for want of knowledge.
  float visibility = 1.0;
  if (all > 0.0) visibility = mix(0.5, seen / max(facing, 1e-20), clamp(20.0 * facing / all, 0.0, 1.0));
  return SkyPart(irradiance, visibility);
}

// What comes from everywhere: the sky's directions and bounced light. rgb: radiance towards the eye; a: share of the
// sky's light that reaches the surface, 0..1.
vec4 ambientLighting(Surface s, vec3 toEye) {
  SkyPart sky = skyPart(s);
  vec3 bounce = bouncedIrradiance(s.normal, sky.visibility);
  float nv = dot(s.normal, toEye);
  vec3 reflected = skyShare(s.f0, s.roughness, nv);
  vec3 diffuse = s.baseColor * (1.0 - s.metallic) * (1.0 - reflected) * (sky.irradiance + bounce);
  // Where the sky is hidden a rough surface reflects the bounced light instead (the blend adds the visible sky). A pixel
  // that asks the screen has it from there.
  vec3 specular = reflected * bounce * (1.0 - sky.visibility);
#ifdef GLOSSY
  if (asksScreen) specular = vec3(0.0);
#endif
#ifdef LOBES
  vec3 fibers = s.sheenColor * sheenAlbedo(max(nv, 0.0), s.sheenRoughness) * (sky.irradiance + bounce);
  diffuse = diffuse * belowSheen(s.sheenColor, s.sheenRoughness, max(nv, 0.0)) + fibers;
  specular *= belowSheen(s.sheenColor, s.sheenRoughness, max(nv, 0.0));
#endif
  return vec4((diffuse + specular) * (s.occlusion / PI), sky.visibility);
}

// The same with what the surface emits and the direct lights that have shadow maps; effects/light_rays adds the others.
vec4 directLighting(Surface s, vec3 toEye) {
  if (s.unlit) return vec4(s.baseColor, 1.0);
#ifdef COATS
  vec3 radiance = directRadiance(s, toEye);
  vec4 ambient = ambientLighting(s, toEye);
  vec3 kept = s.coat > 0.0 ? coatBlend(s, toEye).base : vec3(1.0);
  return vec4(radiance + kept * (s.emissive + ambient.rgb), ambient.a);
#else
  vec3 radiance = s.emissive + directRadiance(s, toEye);
  vec4 ambient = ambientLighting(s, toEye);
  return vec4(radiance + ambient.rgb, ambient.a);
#endif
}
