// Rays to lights from what reflected rays found, in place of the direct light of effects/reflection/shade.comp.
// With PIXEL_QUEUE those rays are pixels, with HIT_SURFACES the method stores attributes, with COATS see lib/coat.glsl,
// with TRANSMISSION lib/clear.glsl.
#include "lib/evaluate_surface.glsl"
#include "lib/lights.glsl"
#include "lib/queued_ray.glsl"
#include "lib/scene.glsl"
#include "effects/light_rays/to_lights.glsl"
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

uniform uint generation;  // of the rays
uniform uint passesOn;    // rays go on behind what blends

void main() {
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (index >= rayCount.count) return;
  Hit hit = hits[index];
  if (hit.triangle == NO_TRIANGLE) return;
#ifdef PIXEL_QUEUE
  Ray ray = queuedRay(index, RAYS_OF_PIXELS);
#ifdef TRANSMISSION
  RayPath path = pixelPathInMedia(pixelOfRay(index), 0u);
#else
  RayPath path = pixelPath(pixelOfRay(index), 0u);
#endif
#else
  Ray ray = queuedRay(index, RAYS_STORED);
  RayPath path = paths[index];
#endif
  float pathLength = path.pathLength + hit.t;
#ifdef TRANSMISSION
  Meeting m = meetingOf(index, ray, hit, ScatteredPath(path.throughput, path.pathLength, path.pixel, 0u, path.media, 0.0));
  pathLength = m.pathLength;
  path.throughput = m.throughput;
  Surface s = m.s;
  takeClear(s, ray.direction, indexRatio(m, 1), false);
  if (!underCoat(m)) s.coat = 0.0;
#elif defined HIT_SURFACES
  Surface s = storedSurface(index, ray, hit);
#else
  Surface s = evaluateSurface(hit.triangle, vec2(hit.u, hit.v), ray.direction, coneWidth(pathLength),
                              READ_TEXTURES);
#endif
  // Slots of a pixel lie side by side in an order of their own.
  uint ofPixel = path.slot % max(frame.glossySamples, 1u);
  vec3 kept = 1.0 - reflectionShare(s.f0, s.roughness, -dot(s.normal, ray.direction));
#ifdef COATS
  if (s.coat > 0.0) kept = vec3(1.0);  // shadeBy() has seen to it
#endif
  bool behind = frame.blends != 0u && passesOn != 0u && s.alpha < 1.0;
  float covers = !behind ? 1.0 : beganOn(path, ray, hit.t) ? 0.0 : s.alpha;
  sendToLights(s, -ray.direction, hit.triangle, path.pixel, path.throughput * kept * covers, pathLength,
               joined(joined(1u, generation), ofPixel));
}
