// Search of a toy: every triangle is tested. Scenes have fewer triangles than drivers allow iterations.
#include "shared/structs.h"
#include "tracing/common/test_candidate.glsl"
#include "tracing/common/walk.glsl"

uniform uint triangleCount;

bool march(TraceRay ray, float end, inout PausedRay pause, inout Hit best) {
  for (uint triangle = 0u; triangle < triangleCount; ++triangle) testCandidate(ray, triangle, best);
  return true;
}

void storeSurface(uint index, Hit hit) {}
