// The queue as a dispatch of one invocation per ray.
#include "tracing/common/trace_ray.glsl"

layout(local_size_x = 64) in;

uniform uint firstRay;  // of the part of the queue that this dispatch takes

void main() {
  uint number = (gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  number += firstRay;
  if (number < raysToTrace()) traceRay(number);
}
