// Between two dispatches of a trace: the next one has nothing to do unless rays are unfinished. One invocation.
#include "shared/bindings.h"
#include "shared/passes/trace.h"
#include "shared/rays.h"

layout(local_size_x = 1) in;
layout(std430, binding = SSBO_RAY_COUNT) coherent buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_RESUME) buffer ResumeBlock { Resume resume; };

void main() {
  uint some = rayCount.unfinished > 0u ? 1u : 0u;
  resume.vertices = 3u * some;
  resume.instances = 1u;
  resume.firstVertex = resume.firstInstance = 0u;
  resume.groupsX = some * rayCount.groupsX;
  resume.groupsY = rayCount.groupsY;
  resume.groupsZ = rayCount.groupsZ;
  resume.times += some;
  rayCount.unfinished = 0u;
}
