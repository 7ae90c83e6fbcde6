// Between two dispatches of a trace: the next one goes over the rays that are unfinished. One invocation.
#include "shared/bindings.h"
#include "shared/passes/trace.h"
#include "shared/rays.h"

layout(local_size_x = 1) in;
layout(std430, binding = SSBO_RAY_COUNT) coherent buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_RESUME) buffer ResumeBlock {
  Resume resume;
  uint waiting[];
};

void main() {
  uint count = rayCount.unfinished;
  resume.count = count;
  resume.times += count > 0u ? 1u : 0u;
  resume.vertices = count > 0u ? 3u : 0u;
  resume.instances = 1u;
  resume.firstVertex = resume.firstInstance = 0u;
  // In rows of as many groups as OpenGL guarantees.
  uint groups = (count + TRACE_GROUP - 1u) / TRACE_GROUP;
  resume.groupsX = min(groups, 65535u);
  resume.groupsY = (groups + 65534u) / 65535u;
  resume.groupsZ = 1u;
  resume.readFrom = resume.writeTo;
  resume.writeTo = uint(waiting.length()) / 2u - resume.readFrom;
  rayCount.unfinished = 0u;
}
