// Turns the count of a ray queue into an indirect dispatch of 64 rays per group. A dispatch takes 65,535 groups along
// an axis, so large queues get rows of groups: ray = 64 * (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) +
// gl_LocalInvocationIndex, if that is below `count`.
#include "shared/bindings.h"
#include "shared/rays.h"
#include "shared/structs.h"

layout(local_size_x = 1) in;

layout(std430, binding = SSBO_RAY_COUNT) buffer RayCountBlock { RayCount rayCount; };

uniform uint capacity;

void main() {
  uint count = min(rayCount.count, capacity);  // what was beyond it is counted as overflow
  uint groups = (count + 63u) / 64u;
  uint rows = (groups + 65534u) / 65535u;
  rayCount.groupsX = rows == 0u ? 0u : (groups + rows - 1u) / rows;
  rayCount.groupsY = max(rows, 1u);
  rayCount.groupsZ = 1u;
  rayCount.count = count;
}
