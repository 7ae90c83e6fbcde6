// Hits of the rays that the structure has answered, to their places. One invocation per ray.
#include "shared/bindings.h"
#include "shared/passes/screen.h"
#include "shared/passes/trace.h"
#include "shared/rays.h"

layout(local_size_x = TRACE_GROUP) in;
layout(std430, binding = SSBO_RAY_COUNT) buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_HITS) writeonly buffer HitBlock { Hit hits[]; };
layout(std430, binding = SSBO_REST_COUNT) readonly buffer RestCountBlock { RayCount restCount; };
layout(std430, binding = SSBO_REST_INDICES) readonly buffer RestIndexBlock { uint restIndices[]; };
layout(std430, binding = SSBO_REST_HITS) readonly buffer RestHitBlock { Hit restHits[]; };

void main() {
  uint number =
      (gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (number == 0u) rayCount.overflow += restCount.overflow;
  if (number < restCount.count) hits[restIndices[number]] = restHits[number];
}
