// What the camera's rays hit, from the G-buffer.
#include "lib/triangle_point.glsl"
#include "lib/queued_ray.glsl"
#include "shared/rays.h"

layout(local_size_x = 64) in;

layout(std430, binding = SSBO_RAY_COUNT) readonly buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_HITS) writeonly buffer HitBlock { Hit hits[]; };

void main() {
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (index >= rayCount.count) return;
  uint number = pixelOfRay(index);
  ivec2 pixel = ivec2(number % frame.width, number / frame.width);
  uint triangle = texelFetch(gVisibility, pixel, 0).x - 1u;
  TrianglePoint point = pointOnTriangle(triangle, pixelOrigin(pixel), pixelRay(pixel));
  hits[index] = Hit(length(point.relative), triangle, point.barycentrics.x, point.barycentrics.y);
}
