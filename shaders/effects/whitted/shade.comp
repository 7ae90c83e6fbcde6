// What the rays found shines, is lit by rays to all lights, and sends on what it reflects and lets pass.
// With CAMERA_HITS rays are the camera's, with LAST_GENERATION nothing is sent on.
#include "effects/common/light_sums.glsl"
#include "lib/dielectric.glsl"
#include "lib/evaluate_surface.glsl"
#include "lib/lights.glsl"
#include "lib/media.glsl"
#include "lib/queued_ray.glsl"
#include "lib/sky.glsl"
#include "lib/triangle_point.glsl"
#ifdef HIT_SURFACES
#include "effects/common/stored_surface.glsl"
#endif

layout(local_size_x = 64) in;

#ifndef CAMERA_HITS
layout(std430, binding = SSBO_PATHS) readonly buffer PathBlock { ScatteredPath paths[]; };
#endif
layout(std430, binding = SSBO_RAY_COUNT) readonly buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_HITS) readonly buffer HitBlock { Hit hits[]; };

#ifndef LAST_GENERATION
// A hit and how its ray came there.
struct Meeting {
  Surface s;
  vec3 direction;  // of the ray
  uint triangle;
  uint pixel;
  uint path;         // a number of the path so far, for what is chosen at random along it
  float pathLength;  // from the eye
  vec3 throughput;   // that the ray arrives with
  uint before;       // the media of the ray, and those behind the surface
  uint behind;
  bool front;
};

#include "effects/whitted/send.glsl"

#ifdef HIT_SURFACES
Surface surfaceOf(uint index, Ray ray, Hit hit, inout float distance, float pathLength) {
  Surface s = storedSurface(index, ray, hit);
  uint material = triangleAt(hit.triangle).w;
  s.transmission = materials[material].transmission;
  s.thin = (materials[material].flags & MATERIAL_THIN) != 0u;
  s.ior = materials[material].ior;
  s.dispersion = materials[material].dispersion;
  s.coat = materials[material].coat;
  s.coatRoughness = materials[material].coatRoughness;
  return s;
}
#else
// The method says which triangle it is; all methods then see the same point of it.
Surface surfaceOf(uint index, Ray ray, Hit hit, inout float distance, float pathLength) {
  TrianglePoint point = pointOnTriangle(hit.triangle, ray.origin, ray.direction);
  distance = dot(point.relative, ray.direction);
  Surface s = evaluateSurface(hit.triangle, point.barycentrics, ray.direction,
                              (pathLength + distance) * frame.pixelCone, ALL_TEXTURES);
  s.position = point.position;
  return s;
}
#endif

void setMedia(inout Meeting m, uint media) {
  vec3 a, b, c;
  trianglePositions(m.triangle, a, b, c);
  uint material = triangleAt(m.triangle).w;
  m.front = dot(cross(b - a, c - a), m.direction) < 0.0;
  m.s.thin = m.s.thin || material >= MEDIA_MATERIALS;
  m.before = m.behind = media;
  if (m.s.thin || m.s.transmission <= 0.0) return;
  if (!m.front && !inMedium(media, material)) m.before = enterMedium(media, material);  // the eye is inside
  m.behind = m.front ? enterMedium(media, material) : leaveMedium(m.before, material);
}
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
    // A light that has a place may be inside a volume.
    float way = ray.maxDistance < FAR_AWAY ? ray.maxDistance : 0.0;
    vec3 light = shadow ? throughMedium(path.media, way) : skyRadiance(ray.direction, 0.0);
    addLight(path.pixel, path.throughput * light);
    return;
  }
#ifndef LAST_GENERATION
  if (shadow && (materials[triangleAt(hit.triangle).w].flags & MATERIAL_TRANSMISSIVE) == 0u) return;
  Meeting m;
  float distance = hit.t;
  m.s = surfaceOf(index, ray, hit, distance, path.pathLength);
  m.direction = ray.direction;
  m.triangle = hit.triangle;
  m.pixel = path.pixel;
  m.path = path.kindAndSample >> 8;
  m.pathLength = path.pathLength + distance;
  setMedia(m, path.media);
  m.throughput = path.throughput * throughMedium(m.before, distance);
  if (shadow)
    sendThrough(m, ray.maxDistance < FAR_AWAY ? ray.maxDistance - distance : FAR_AWAY);
  else if (m.s.unlit)
    addLight(m.pixel, m.throughput * m.s.baseColor);
  else
    shadeMeeting(m);
#endif
}
