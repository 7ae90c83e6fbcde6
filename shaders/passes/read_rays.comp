// The rays of a queue, written whole for the host.
#include "lib/queued_ray.glsl"
#include "shared/passes/read_rays.h"

layout(local_size_x = 64) in;

layout(std430, binding = SSBO_RAY_COUNT) readonly buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_READ_RAYS) writeonly buffer ReadRayBlock { Ray readRays[]; };

uniform uint firstRay;

void main() {
  uint number = gl_GlobalInvocationID.x, index = firstRay + number;
  if (index < rayCount.count) readRays[number] = queuedRay(index, rayCount.source);
}
