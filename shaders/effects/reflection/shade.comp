// Shades what the rays found, with the lights of the deferred pass, adds it to the rays' slots and sends on the rays of
// the next bounce.
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

layout(local_size_x = 64) in;

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
#endif

#ifdef PIXEL_QUEUE
const uint raySource = RAYS_OF_PIXELS;
RayPath loadPath(uint index, Ray ray) {
  return RayPath(vec3(1.0), length(ray.origin - frame.eye), pixelOfRay(index), RAY_REFLECTION, index, 0u);
}
#else
const uint raySource = RAYS_STORED;
RayPath loadPath(uint index, Ray ray) { return paths[index]; }
#endif

void main() {
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (index >= rayCount.count) return;
  Ray ray = queuedRay(index, raySource);
  RayPath path = loadPath(index, ray);
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
#ifdef HIT_SURFACES
  Surface s = storedSurface(index, ray, hit);
#else
  Surface s = evaluateSurface(hit.triangle, vec2(hit.u, hit.v), direction, pathLength * frame.pixelCone,
                              BASE_TEXTURES);
#endif
  vec4 lit = directLighting(s, -direction);
  vec3 radiance = lit.rgb;
  if (!s.unlit) {
    float cosine = -dot(s.normal, direction);
    vec3 share = reflectionShare(s.f0, s.roughness, cosine);
    vec3 reflected = reflect(direction, s.normal);
    vec3 sky = skyRadiance(reflected, s.roughness) * lit.a;
    radiance = (1.0 - share) * lit.rgb + skyShare(s.f0, s.roughness, cosine) * sky;
    bool sentOn = false;
#ifdef NEXT_BOUNCE
    if (s.reflectivity > frame.minReflectivity) {
      uint next = atomicAdd(nextCount.count, 1u);  // at most one per ray: as many as this queue holds
      atomicAdd(nextCount.byKind[RAY_REFLECTION], 1u);
      nextRays[next] = Ray(s.position, FAR_AWAY, reflected, hit.triangle);
      nextPaths[next] = RayPath(path.throughput * share, pathLength, path.pixel, path.kind, path.slot, 0u);
      sentOn = true;
    }
#endif
    if (!sentOn) radiance += share * sky;
  }
  slots[path.slot] = Radiance(sum + path.throughput * radiance, path.pixel);
}
