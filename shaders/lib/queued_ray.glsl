// The rays of a queue, however they are stored: whole, or as the pixel that they start from. All else of a first ray
// stands in the G-buffer.
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "shared/bindings.h"
#include "shared/rays.h"

layout(std430, binding = SSBO_RAYS) readonly buffer RayBlock { uvec4 rayRows[]; };

uint pixelOfRay(uint index) { return rayRows[index >> 2][index & 3u]; }

// The mirror image of the line from the eye to the pixel's surface. `precise`: every program must see the same ray.
Ray mirrorRay(uint number) {
  ivec2 pixel = ivec2(number % frame.width, number / frame.width);
  vec3 position = texelFetch(gPosition, pixel, 0).xyz;
  precise vec3 fromEye = normalize(position - frame.eye);
  precise vec3 direction = normalize(reflect(fromEye, texelFetch(gNormal, pixel, 0).xyz));
  return Ray(position, FAR_AWAY, direction, texelFetch(gVisibility, pixel, 0).x - 1u);
}

// From the eye to the pixel's surface.
Ray cameraRay(uint number) {
  ivec2 pixel = ivec2(number % frame.width, number / frame.width);
  vec3 position = texelFetch(gPosition, pixel, 0).xyz;
  precise vec3 direction = normalize(position - frame.eye);
  return Ray(frame.eye, FAR_AWAY, direction, NO_TRIANGLE);
}

// source: RayCount::source.
Ray queuedRay(uint index, uint source) {
  if (source == RAYS_OF_CAMERA) return cameraRay(pixelOfRay(index));
  if (source == RAYS_OF_PIXELS) return mirrorRay(pixelOfRay(index));
  uvec4 start = rayRows[2u * index], way = rayRows[2u * index + 1u];
  return Ray(uintBitsToFloat(start.xyz), uintBitsToFloat(start.w), uintBitsToFloat(way.xyz), way.w);
}
