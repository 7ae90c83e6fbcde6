// What a ray that may pass through surfaces meets. The includer says what SSBO_HIT_SURFACES is.
#include "lib/clear.glsl"
#include "lib/evaluate_surface.glsl"
#include "lib/media.glsl"
#include "lib/triangle_point.glsl"
#include "shared/rays.h"
#ifdef HIT_SURFACES
#include "effects/common/stored_surface.glsl"
#endif

// A hit and how its ray came there.
struct Meeting {
  Surface s;
  vec3 direction;  // of the ray
  uint triangle;
  uint pixel;
  uint path;         // a number of the path so far, for what is chosen at random along it
  float distance;    // of the ray
  float pathLength;  // from the eye
  vec3 throughput;   // that the ray arrives with
  uint before;       // the media of the ray, and those behind the surface
  uint behind;
  bool front;
};

#ifdef HIT_SURFACES
Surface surfaceOf(uint index, Ray ray, Hit hit, inout float distance, float pathLength) {
  return storedSurface(index, ray, hit);
}
#else
// The method says which triangle it is; all methods then see the same point of it.
Surface surfaceOf(uint index, Ray ray, Hit hit, inout float distance, float pathLength) {
  TrianglePoint point = pointOnTriangle(hit.triangle, ray.origin, ray.direction);
  distance = dot(point.relative, ray.direction);
  Surface s = evaluateSurface(hit.triangle, point.barycentrics, ray.direction,
                              coneWidth(pathLength + distance), ALL_TEXTURES);
  s.position = point.position;
  return s;
}
#endif

void setMedia(inout Meeting m, uint media) {
  uint material = triangleAt(m.triangle).w;
  m.front = meetsFront(m.triangle, m.direction);
  m.s.thin = m.s.thin || material >= MEDIA_MATERIALS;
  m.before = m.behind = media;
  if (m.s.thin || m.s.transmission <= 0.0) return;
  if (!m.front && !inMedium(media, material)) m.before = enterMedium(media, material);  // the eye is inside
  m.behind = m.front ? enterMedium(media, material) : leaveMedium(m.before, material);
}

Meeting meetingOf(uint index, Ray ray, Hit hit, ScatteredPath path) {
  Meeting m;
  m.distance = hit.t;
  m.s = surfaceOf(index, ray, hit, m.distance, path.pathLength);
  m.direction = ray.direction;
  m.triangle = hit.triangle;
  m.pixel = path.pixel;
  m.path = path.kindAndSample >> 8;
  m.pathLength = path.pathLength + m.distance;
  setMedia(m, path.media);
  m.throughput = path.throughput * throughMedium(m.before, m.distance);
  return m;
}

// A light that has a place may be inside a volume.
float wayToLight(Ray ray) { return ray.maxDistance < FAR_AWAY ? ray.maxDistance : 0.0; }

bool isClear(Hit hit) {
  uint clear = frame.blends != 0u ? MATERIAL_TRANSMISSIVE | MATERIAL_BLEND : MATERIAL_TRANSMISSIVE;
  return (materials[triangleAt(hit.triangle).w].flags & clear) != 0u;
}

const float COAT_INDEX = 1.5;

bool underCoat(Meeting m) { return m.s.coat > 0.0 && (m.front || m.s.thin || m.s.transmission <= 0.0); }

float coatReflectance(Meeting m) {
  if (!underCoat(m)) return 0.0;
  return m.s.coat * meetInterface(m.direction, m.s.coatNormal, 1.0 / COAT_INDEX).reflectance;
}

// Index of refraction before the surface over that behind it.
float indexRatio(Meeting m, int color) {
  float behind = m.s.thin ? indexOf(m.s.ior, m.s.dispersion, color) : indexOfMedium(m.behind, color);
  return indexOfMedium(m.before, color) / behind;
}

// The way of what is reflected. Its media are those before the surface, so it must not begin behind a clear one.
vec3 directionBefore(Meeting m, vec3 normal) {
  vec3 direction = reflect(m.direction, normal);
  if (m.s.transmission > 0.0 && dot(direction, m.s.geometricNormal) <= 0.0)
    direction = reflect(m.direction, m.s.geometricNormal);
  return direction;
}

// The way of what passes. A normal that is interpolated may bend a ray out again: then the triangle's own, or nothing
// bends it.
vec3 directionBehind(Meeting m, Interface border, float ratio) {
  vec3 direction = m.s.thin ? m.direction : border.refracted;
  if (dot(direction, m.s.geometricNormal) >= 0.0)
    direction = meetInterface(m.direction, m.s.geometricNormal, ratio).refracted;
  return dot(direction, m.s.geometricNormal) >= 0.0 ? m.direction : direction;
}
