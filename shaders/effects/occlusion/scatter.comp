// Rays of ambient occlusion: from each pixel's surface in directions as often as the cosine says, so that each counts
// the same. One invocation per pixel of the queue.
#include "effects/common/send_on.glsl"
#include "lib/queued_ray.glsl"
#include "lib/random.glsl"
#include "lib/sampling.glsl"
#include "lib/triangles.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = SSBO_RAY_COUNT) readonly buffer RayCountBlock { RayCount rayCount; };

uniform uint firstSample;  // of this pass

void main() {
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (index >= rayCount.count) return;
  uint number = pixelOfRay(index);
  ivec2 pixel = ivec2(number % frame.width, number / frame.width);
  vec3 position = texelFetch(gPosition, pixel, 0).xyz, normal = texelFetch(gNormal, pixel, 0).xyz;
  uint triangle = texelFetch(gVisibility, pixel, 0).x - 1u;
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  vec3 geometric = cross(b - a, c - a);
  geometric = dot(geometric, geometric) > 0.0 ? normalize(geometric) : normal;
  if (dot(geometric, fromCamera(position)) > 0.0) geometric = -geometric;
  float pathLength = length(fromCamera(position));
  for (uint i = 0u; i < frame.effectSamples; ++i) {
    vec3 direction = cosineDirection(normal, sample2(number, firstSample + i, 0u));
    // An interpolated normal's hemisphere reaches below the triangle's plane, where the surface would hide itself.
    if (dot(direction, geometric) < 0.0) direction = reflect(direction, geometric);
    sendOn(Ray(position, frame.occlusionRadius, direction, triangle),
           ScatteredPath(vec3(1.0), pathLength, number, RAY_OCCLUSION | i << 8, 0u, 0.0));
  }
}
