// Shades what the rays found, with the lights of the deferred pass, adds it to the rays' slots and sends on the rays of
// the next bounce, or those that go on behind surfaces that blend. With COATS see lib/coat.glsl, with TRANSMISSION
// lib/clear.glsl: a clear surface then sends on what it lets pass or what it reflects, whichever is more.
#include "lib/coat.glsl"
#include "lib/evaluate_surface.glsl"
#include "lib/lights.glsl"
#include "lib/queued_ray.glsl"
#include "lib/scene.glsl"
#include "lib/sky.glsl"
#include "shared/passes/shade_hits.h"
#include "shared/rays.h"
#ifdef HIT_SURFACES
#include "effects/common/stored_surface.glsl"
#endif
#ifdef TRANSMISSION
#include "effects/common/meeting.glsl"
#include "effects/common/pixel_media.glsl"
#endif

layout(local_size_x = 64) in;

#ifdef COATS
const uint READ_TEXTURES = ALL_TEXTURES;
#else
const uint READ_TEXTURES = BASE_TEXTURES;
#endif

#ifndef PIXEL_QUEUE
layout(std430, binding = SSBO_PATHS) readonly buffer PathBlock { RayPath paths[]; };
#endif
layout(std430, binding = SSBO_RAY_COUNT) readonly buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_HITS) readonly buffer HitBlock { Hit hits[]; };
layout(std430, binding = SSBO_SLOTS) buffer SlotBlock { Radiance slots[]; };
#ifdef NEXT_BOUNCE
layout(std430, binding = SSBO_NEXT_RAYS) writeonly buffer NextRayBlock { Ray nextRays[]; };
layout(std430, binding = SSBO_NEXT_PATHS) writeonly buffer NextPathBlock { RayPath nextPaths[]; };
layout(std430, binding = SSBO_NEXT_COUNT) buffer NextCountBlock { RayCount nextCount; };

// At most one per ray: as many as this queue holds.
void sendOn(Ray ray, RayPath path) {
  uint next = atomicAdd(nextCount.count, 1u);
  atomicAdd(nextCount.byKind[path.kindAndCounts & 255u], 1u);
  nextRays[next] = ray;
  nextPaths[next] = path;
}
#endif

#ifdef PIXEL_QUEUE
const uint raySource = RAYS_OF_PIXELS;
RayPath loadPath(uint index) {
#ifdef TRANSMISSION
  return pixelPathInMedia(pixelOfRay(index), index);
#else
  return pixelPath(pixelOfRay(index), index);
#endif
}
#else
const uint raySource = RAYS_STORED;
RayPath loadPath(uint index) { return paths[index]; }
#endif

// What a hit sends on, or the sky there.
struct Way {
  vec3 share, direction, sky;
  bool open;  // to a ray
  uint kindAndCounts, media;
};

#ifdef TRANSMISSION
// The larger one of what is reflected and what passes; the sky's share of the other one is added to `radiance`. Inside of
// a volume, reflections are like refractions no bounces.
Way largerWay(Meeting m, RayPath path, Way reflected, vec3 passing, float visibility, inout vec3 radiance) {
  float ratio = indexRatio(m, 1);
  vec3 behind = directionBehind(m, meetInterface(m.direction, m.s.normal, ratio), ratio);
  bool open = clearSurfacesOf(path) < uint(MOST_CLEAR);
  uint counts = countsOf(path) + COUNTED_CLEAR;
  Way through = Way(passing, behind, skyRadiance(behind, m.s.roughness) * visibility,
                    open && any(greaterThan(passing, vec3(0.0))), RAY_REFRACTION | counts, m.behind);
  if (m.before != 0u) {
    reflected.open = open;
    reflected.kindAndCounts = RAY_REFLECTION | counts;
  }
  bool passes = luminance(through.share) >= luminance(reflected.share);
  radiance += passes ? reflected.share * reflected.sky : through.share * through.sky;
  if (passes) return through;
  return reflected;
}
#endif

void main() {
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (index >= rayCount.count) return;
  Ray ray = queuedRay(index, raySource);
  RayPath path = loadPath(index);
  Hit hit = hits[index];
  vec3 direction = ray.direction;
#ifdef FIRST_GENERATION
  // A pixel whose ray was given up falls back to the sky in the blend; a longer path ends in the sky.
  if (hit.triangle == NO_TRIANGLE && hit.t != HIT_MISS) {
    slots[path.slot] = Radiance(vec3(0.0), NO_PIXEL);
    return;
  }
  vec3 sum = vec3(0.0);
#else
  vec3 sum = slots[path.slot].sum;
#endif
  if (hit.triangle == NO_TRIANGLE) {
    slots[path.slot] = Radiance(sum + path.throughput * skyRadiance(direction, 0.0), path.pixel);
    return;
  }

  float pathLength = path.pathLength + hit.t;
#ifdef TRANSMISSION
  Meeting m = meetingOf(index, ray, hit, ScatteredPath(path.throughput, path.pathLength, path.pixel, 0u, path.media, 0.0));
  pathLength = m.pathLength;
  path.throughput = m.throughput;
  Surface s = m.s;
  vec3 passing = takeClear(s, direction, indexRatio(m, 1), false);
  if (!underCoat(m)) s.coat = 0.0;
  path.media = m.before;
#elif defined HIT_SURFACES
  Surface s = storedSurface(index, ray, hit);
#else
  Surface s = evaluateSurface(hit.triangle, vec2(hit.u, hit.v), direction, coneWidth(pathLength),
                              READ_TEXTURES);
#endif
  vec4 lit = directLighting(s, -direction);
  vec3 radiance = lit.rgb;
  bool behind = false;
#ifdef NEXT_BOUNCE
  behind = frame.blends != 0u && s.alpha < 1.0;
#endif
  if (!s.unlit) {
#ifdef COATS
    CoatBlend b = coatBlend(s, -direction);
    vec3 share = b.share, mirror = b.ofCoat ? s.coatNormal : s.normal, reflected = reflect(direction, mirror);
    float reflectivity = followedReflectivity(s, b.ofCoat), roughness = b.ofCoat ? s.coatRoughness : s.roughness;
    vec3 sky = skyRadiance(reflected, roughness) * lit.a;
    radiance = (s.coat > 0.0 ? vec3(1.0) : b.base) * lit.rgb +
               b.skyInBase * skyRadiance(reflect(direction, s.normal), s.roughness) * lit.a +
               b.skyInCoat * skyRadiance(reflect(direction, s.coatNormal), s.coatRoughness) * lit.a;
#else
    float cosine = -dot(s.normal, direction), reflectivity = s.reflectivity;
    vec3 share = reflectionShare(s.f0, s.roughness, cosine);
    vec3 mirror = s.normal, reflected = reflect(direction, mirror);
    vec3 sky = skyRadiance(reflected, s.roughness) * lit.a;
    radiance = (1.0 - share) * lit.rgb + skyShare(s.f0, s.roughness, cosine) * sky;
#endif
    Way way = Way(share, reflected, sky, reflectivity > frame.minReflectivity && reflectionsOf(path) < frame.bounces,
                  RAY_REFLECTION | (countsOf(path) + COUNTED_REFLECTION), path.media);
#ifdef TRANSMISSION
    if (m.s.transmission > 0.0) {
      way.direction = directionBefore(m, mirror);
      passing *= 1.0 - filmReflectance(s.coat, -dot(s.coatNormal, direction));
      way = largerWay(m, path, way, passing, lit.a, radiance);
    }
#endif
    bool sentOn = false;
#ifdef NEXT_BOUNCE
    if (!behind && way.open) {
      sendOn(Ray(s.position, FAR_AWAY, way.direction, hit.triangle),
             RayPath(path.throughput * way.share, pathLength, path.pixel, way.kindAndCounts, path.slot, way.media));
      sentOn = true;
    }
#endif
    if (!sentOn) radiance += way.share * way.sky;
  }
#ifdef NEXT_BOUNCE
  if (behind) {
    bool again = beganOn(path, ray, hit.t);
    float covers = again ? 0.0 : s.alpha;
    radiance *= covers;
    sendOn(again ? Ray(s.position, FAR_AWAY, direction, hit.triangle) : rayBehind(s.position, direction, hit.triangle),
           RayPath(path.throughput * (1.0 - covers), pathLength, path.pixel, RAY_THROUGH | countsOf(path), path.slot,
                   path.media));
  }
#endif
  slots[path.slot] = Radiance(sum + path.throughput * radiance, path.pixel);
}
