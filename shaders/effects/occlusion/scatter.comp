// The rays of ambient occlusion from each pixel's surface. One invocation per pixel of the queue.
#include "effects/occlusion/send.glsl"
#include "lib/queued_ray.glsl"
#include "lib/triangles.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = SSBO_RAY_COUNT) readonly buffer RayCountBlock { RayCount rayCount; };

void main() {
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (index >= rayCount.count) return;
  uint number = pixelOfRay(index);
  ivec2 pixel = ivec2(number % frame.width, number / frame.width);
  vec3 position = surfacePoint(pixel).xyz, normal = facingAt(pixel).xyz;
  uint triangle = texelFetch(gVisibility, pixel, 0).x - 1u;
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  vec3 geometric = cross(b - a, c - a);
  geometric = dot(geometric, geometric) > 0.0 ? normalize(geometric) : normal;
  if (dot(geometric, fromCamera(position)) > 0.0) geometric = -geometric;
  float pathLength = length(fromCamera(position));
  for (uint i = 0u; i < frame.effectSamples; ++i)
    sendOcclusionRay(position, normal, geometric, triangle, pathLength, number, i);
}
