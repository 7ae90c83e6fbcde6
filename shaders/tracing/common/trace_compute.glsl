// The queue as a dispatch of one invocation per ray.
#include "tracing/common/trace_ray.glsl"

layout(local_size_x = 64) in;

void main() {
  uint number = (gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (number < raysToTrace()) traceRay(number);
}
