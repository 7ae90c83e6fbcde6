// What rays to lights bring: all if nothing was in their way, what goes on behind clear surfaces, else nothing.
// With LAST_GENERATION nothing goes on.
#include "effects/common/light_sums.glsl"
#include "effects/common/meeting.glsl"
#include "lib/queued_ray.glsl"
#ifndef LAST_GENERATION
#include "effects/common/send_through.glsl"
#endif

layout(local_size_x = 64) in;

layout(std430, binding = SSBO_PATHS) readonly buffer PathBlock { ScatteredPath paths[]; };
layout(std430, binding = SSBO_RAY_COUNT) readonly buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_HITS) readonly buffer HitBlock { Hit hits[]; };

void main() {
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (index >= rayCount.count) return;
  Hit hit = hits[index];
  ScatteredPath path = paths[index];
  Ray ray = queuedRay(index, RAYS_STORED);
  if (hit.triangle == NO_TRIANGLE) {
    if (hit.t == HIT_MISS) addLight(path.pixel, path.throughput * throughMedium(path.media, wayToLight(ray)));
    return;  // what was given up is counted
  }
#ifndef LAST_GENERATION
  if (isClear(hit)) sendThrough(meetingOf(index, ray, hit, path), ray);
#endif
}
