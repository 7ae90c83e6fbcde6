// The rays of a queue, however they are stored: whole, or as the pixel that they start from. All else of a first ray
// stands in the G-buffer.
#include "lib/frame.glsl"
#include "lib/surface_point.glsl"
#include "shared/bindings.h"
#include "shared/rays.h"

layout(std430, binding = SSBO_RAYS) readonly buffer RayBlock { uvec4 rayRows[]; };

uint pixelOfRay(uint index) { return rayRows[index >> 2][index & 3u]; }

// A few rounding steps of a position's coordinates.
float roundingAt(vec3 position) {
  vec3 size = abs(position);
  return min(NEAREST_SHARE * max(size.x, max(size.y, size.z)), frame.minDistance);
}

// On behind a surface, from so far before it that what lies on it is found.
Ray rayBehind(vec3 position, vec3 direction, uint triangle) {
  precise vec3 origin = position - 16.0 * roundingAt(position) * direction;
  return Ray(origin, FAR_AWAY, direction, triangle);
}

// Whether a surface that blends, hit by such a ray, is the one that it began on: on an edge that two triangles share.
bool beganOn(RayPath path, Ray ray, float t) {
  return (path.kindAndCounts & 255u) == RAY_THROUGH && t < 24.0 * roundingAt(ray.origin);
}

uint reflectionsOf(RayPath path) { return path.kindAndCounts / COUNTED_REFLECTION & 255u; }
uint clearSurfacesOf(RayPath path) { return path.kindAndCounts / COUNTED_CLEAR; }
// All but the kind.
uint countsOf(RayPath path) { return path.kindAndCounts & ~255u; }

// The mirror image of the line from the eye to the pixel's surface, or the same way on behind a surface that blends.
// `precise`: every program must see the same ray.
Ray mirrorRay(uint number) {
  ivec2 pixel = ivec2(number % frame.width, number / frame.width);
  vec3 position = surfacePoint(pixel).xyz;
  vec4 normal = facingAt(pixel);
  uint triangle = texelFetch(gVisibility, pixel, 0).x - 1u;
  precise vec3 fromEye = normalize(fromCamera(position));
  if (goesOn(normal)) return rayBehind(position, fromEye, triangle);
  precise vec3 direction = normalize(reflect(fromEye, normal.xyz));
  return Ray(position, FAR_AWAY, direction, triangle);
}

// What an effect would have stored of it.
RayPath pixelPath(uint number, uint slot) {
  ivec2 pixel = ivec2(number % frame.width, number / frame.width);
  bool behind = goesOn(facingAt(pixel));
  return RayPath(vec3(1.0), length(fromCamera(surfacePoint(pixel).xyz)), number,
                 behind ? RAY_THROUGH : RAY_REFLECTION | COUNTED_REFLECTION, slot, 0u);
}

// From the eye to the pixel's surface.
Ray cameraRay(uint number) {
  ivec2 pixel = ivec2(number % frame.width, number / frame.width);
  vec3 position = surfacePoint(pixel).xyz;
  precise vec3 direction = normalize(fromCamera(position));
  vec3 origin = frame.parallel == 0u ? frame.eye : position - fromCamera(position);
  return Ray(origin, FAR_AWAY, direction, NO_TRIANGLE);
}

// source: RayCount::source.
Ray queuedRay(uint index, uint source) {
  if (source == RAYS_OF_CAMERA) return cameraRay(pixelOfRay(index));
  if (source == RAYS_OF_PIXELS) return mirrorRay(pixelOfRay(index));
  uvec4 start = rayRows[2u * index], way = rayRows[2u * index + 1u];
  return Ray(uintBitsToFloat(start.xyz), uintBitsToFloat(start.w), uintBitsToFloat(way.xyz), way.w);
}
