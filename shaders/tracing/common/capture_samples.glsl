// Reflecting pixels of the frame, by an even grid of samples.
#include "lib/surface_point.glsl"

const ivec2 SAMPLES = ivec2(128, 72);

struct ReflectingPixel {
  bool reflects;
  vec3 position;
  vec3 normal;  // of the triangle, towards the camera, unit
};

ReflectingPixel sampledPixel(int number) {
  ReflectingPixel result = ReflectingPixel(false, vec3(0.0), vec3(0.0));
  ivec2 cell = ivec2(number % SAMPLES.x, number / SAMPLES.x);
  ivec2 pixel = (2 * cell + 1) * ivec2(frame.width, frame.height) / (2 * SAMPLES);
  uint seen = texelFetch(gVisibility, pixel, 0).x;
  float reflectivity = facingAt(pixel).w;
  if (seen == 0u || (frame.selectMode != 2u && reflectivity <= frame.minReflectivity)) return result;
  vec3 a, b, c;
  trianglePositions(seen - 1u, a, b, c);
  vec3 normal = cross(b - a, c - a);
  float size = length(normal);
  if (size == 0.0) return result;
  result.reflects = true;
  result.position = surfacePoint(pixel).xyz;
  result.normal = normal / (dot(normal, fromCamera(a)) > 0.0 ? -size : size);
  return result;
}
