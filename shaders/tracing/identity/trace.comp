// Each invocation takes several rays of the queue in turn: whoever is through takes the next, so rays of unlike lengths
// wait less for each other (after the dynamic fetch of Aila & Laine 2009).
#include "shared/passes/trace.h"
#include "tracing/common/ray_queue.glsl"
#include "tracing/identity/search.glsl"

layout(local_size_x = TRACE_GROUP) in;
uniform uint raysPerInvocation;

uint taken = 0u;

bool takeRay(out uint index) {
  uint group = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  uint number = (group * raysPerInvocation + taken) * TRACE_GROUP + gl_LocalInvocationIndex;
  bool some = taken < raysPerInvocation && number < raysToTrace();
  ++taken;
  index = some ? rayToTrace(number) : 0u;
  return some;
}

void main() {
  traceRays();
  // Those that the invocation had no iterations left for.
  uint index;
  while (takeRay(index)) postpone(index);
}
