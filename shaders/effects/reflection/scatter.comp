// Rays of glossy reflections: each pixel of the queue sends frame.glossySamples of them, as often as its visible
// microfacets face that way (Heitz 2018). One invocation per pixel.
#include "effects/reflection/lobe.glsl"
#include "lib/blend.glsl"
#include "lib/queued_ray.glsl"
#include "lib/random.glsl"
#include "shared/passes/shade_hits.h"

layout(local_size_x = 64) in;

layout(std430, binding = SSBO_RAY_COUNT) readonly buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_NEXT_RAYS) writeonly buffer NextRayBlock { Ray nextRays[]; };
layout(std430, binding = SSBO_NEXT_PATHS) writeonly buffer NextPathBlock { RayPath nextPaths[]; };
layout(std430, binding = SSBO_NEXT_COUNT) buffer NextCountBlock { RayCount nextCount; };

void main() {
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (index >= rayCount.count) return;
  if (index == 0u) {
    nextCount.count = rayCount.count * frame.glossySamples;
    nextCount.reflecting = rayCount.reflecting;
    uint behind = rayCount.byKind[RAY_THROUGH];
    nextCount.byKind[RAY_REFLECTION] += (rayCount.count - behind) * frame.glossySamples;
    nextCount.byKind[RAY_THROUGH] += behind * frame.glossySamples;
  }
  uint number = pixelOfRay(index);
  ivec2 pixel = ivec2(number % frame.width, number / frame.width);
  Ray ray = mirrorRay(number);
  vec4 stored = facingAt(pixel);
  bool behind = goesOn(stored);
  vec3 fromEye = fromCamera(ray.origin);
  vec3 toEye = -normalize(fromEye);
  vec4 material = texelFetch(gMaterial, pixel, 0);
  Lobe lobe = lobeOf(mirrorOf(pixel, material, stored.xyz, toEye).f0, material.a, stored.xyz, toEye);
  for (uint i = 0u; i < frame.glossySamples; ++i) {
    vec3 weight = vec3(1.0);
    if (!smoothLobe(lobe.alpha) && !behind)
      weight = sampleLobe(lobe, sample2(number, frame.firstPass * frame.glossySamples + i, 0u), ray.direction);
    uint slot = index * frame.glossySamples + i;
    nextRays[slot] = ray;
    uint kind = behind ? RAY_THROUGH : RAY_REFLECTION | COUNTED_REFLECTION;
    nextPaths[slot] = RayPath(weight, length(fromEye), number, kind, slot, 0u);
  }
}
