// The count of the rays that the screen has not answered, as a dispatch over them. One invocation.
#include "shared/bindings.h"
#include "shared/passes/screen.h"
#include "shared/passes/trace.h"
#include "shared/rays.h"

layout(local_size_x = 1) in;
layout(std430, binding = SSBO_RAY_COUNT) buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_REST_COUNT) buffer RestCountBlock { RayCount restCount; };

void main() {
  uint groups = (restCount.count + TRACE_GROUP - 1u) / TRACE_GROUP;
  uint rows = max((groups + 65534u) / 65535u, 1u);
  restCount.groupsX = (groups + rows - 1u) / rows;
  restCount.groupsY = rows;
  restCount.groupsZ = 1u;
  restCount.source = rayCount.source;
  rayCount.byKind[COUNT_ANSWERED_FIRST] += rayCount.count - restCount.count;
  rayCount.byKind[COUNT_ANSWERED_BY_STRUCTURE] += restCount.count;
}
