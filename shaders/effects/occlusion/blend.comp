// Ambient occlusion where surfaces blend: they are there as often as their alpha says to the eye, and hide as much.
// With CAMERA_HITS rays are the camera's and begin all samples of a pass; with LAST_GENERATION nothing is sent on.
#include "effects/common/light_sums.glsl"
#include "lib/evaluate_surface.glsl"
#include "lib/queued_ray.glsl"
#include "lib/scene.glsl"
#include "lib/triangle_point.glsl"
#ifndef LAST_GENERATION
#include "effects/occlusion/send.glsl"
#endif

layout(local_size_x = 64) in;

#ifndef CAMERA_HITS
layout(std430, binding = SSBO_PATHS) readonly buffer PathBlock { ScatteredPath paths[]; };
#endif
layout(std430, binding = SSBO_RAY_COUNT) readonly buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_HITS) readonly buffer HitBlock { Hit hits[]; };

#ifndef LAST_GENERATION
uniform uint generation;

// What the eye sees of a surface: occlusion rays from it, or what is behind it.
void meet(Surface s, ScatteredPath path, vec3 direction, uint triangle, uint sampleNumber) {
  float number = s.alpha < 1.0 ? sample2(path.pixel, firstSample + sampleNumber, 1u + generation).x : 0.0;
  if (number < s.alpha) {
    sendOcclusionRay(s.position, s.normal, s.geometricNormal, triangle, path.pathLength, path.pixel, sampleNumber);
    return;
  }
  path.kindAndSample = RAY_THROUGH | sampleNumber << 8;
  sendOn(Ray(s.position, FAR_AWAY, direction, triangle), path);
}
#endif

void main() {
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (index >= rayCount.count) return;
#ifdef CAMERA_HITS
  Ray ray = cameraRay(pixelOfRay(index));
  ScatteredPath path = ScatteredPath(vec3(1.0), 0.0, pixelOfRay(index), RAY_THROUGH, 0u, 0.0);
#else
  Ray ray = queuedRay(index, RAYS_STORED);
  ScatteredPath path = paths[index];
#endif
  Hit hit = hits[index];
  if (hit.triangle == NO_TRIANGLE) {
    if (hit.t == HIT_MISS) addLight(path.pixel, path.throughput);
    return;  // what was given up is counted
  }
#ifndef LAST_GENERATION
  bool occlusion = (path.kindAndSample & 255u) == RAY_OCCLUSION;
  bool blend = (materials[triangleAt(hit.triangle).w].flags & MATERIAL_BLEND) != 0u;
  if (occlusion && !blend) return;
  TrianglePoint point = pointOnTriangle(hit.triangle, ray.origin, ray.direction);
  float distance = dot(point.relative, ray.direction);
  path.pathLength += distance;
  Surface s =
      evaluateSurface(hit.triangle, point.barycentrics, ray.direction, coneWidth(path.pathLength), BASE_TEXTURES);
  s.position = point.position;
#ifdef CAMERA_HITS
  for (uint i = 0u; i < frame.effectSamples; ++i) meet(s, path, ray.direction, hit.triangle, i);
#else
  if (!occlusion) {
    meet(s, path, ray.direction, hit.triangle, path.kindAndSample >> 8);
    return;
  }
  path.throughput *= 1.0 - s.alpha;
  float left = ray.maxDistance < FAR_AWAY ? ray.maxDistance - distance : FAR_AWAY;
  if (s.alpha < 1.0) sendOn(Ray(s.position, left, ray.direction, hit.triangle), path);
#endif
#endif
}
