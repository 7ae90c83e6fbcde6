// What the rays found shines, is lit by rays to all lights, and sends on what it reflects and lets pass.
// With CAMERA_HITS rays are the camera's, with SHADOW_MARKS the lights that these see for certain need no rays, with
// LAST_GENERATION nothing is sent on.
#include "effects/common/light_sums.glsl"
#include "effects/common/meeting.glsl"
#include "lib/lights.glsl"
#include "lib/queued_ray.glsl"
#include "lib/sky.glsl"

layout(local_size_x = 64) in;

#ifndef CAMERA_HITS
layout(std430, binding = SSBO_PATHS) readonly buffer PathBlock { ScatteredPath paths[]; };
#endif
layout(std430, binding = SSBO_RAY_COUNT) readonly buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_HITS) readonly buffer HitBlock { Hit hits[]; };

#ifndef LAST_GENERATION
#include "effects/whitted/send.glsl"
#endif

void main() {
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (index >= rayCount.count) return;
#ifdef CAMERA_HITS
  Ray ray = cameraRay(pixelOfRay(index));
  ScatteredPath path = ScatteredPath(vec3(1.0), 0.0, pixelOfRay(index), RAY_REFLECTION, 0u, 0.0);
#else
  Ray ray = queuedRay(index, RAYS_STORED);
  ScatteredPath path = paths[index];
#endif
  Hit hit = hits[index];
  bool shadow = (path.kindAndSample & 255u) == RAY_SHADOW;
  if (hit.triangle == NO_TRIANGLE) {
    if (hit.t != HIT_MISS) return;  // given up, and counted
    vec3 light = shadow ? throughMedium(path.media, wayToLight(ray)) : skyRadiance(ray.direction, 0.0);
    addLight(path.pixel, path.throughput * light);
    return;
  }
#ifndef LAST_GENERATION
  if (shadow && !isClear(hit)) return;
  Meeting m = meetingOf(index, ray, hit, path);
  if (shadow) {
    sendThrough(m, ray);
    return;
  }
  passOn(m);
  if (m.s.unlit)
    addLight(m.pixel, m.throughput * m.s.baseColor);
  else
    shadeMeeting(m);
#endif
}
