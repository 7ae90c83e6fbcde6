// Triangles for a draw, collected by compute shaders of one invocation per triangle.
#include "shared/passes/identity.h"
#include "tracing/identity/brick_work.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = SSBO_CANDIDATES) writeonly buffer CandidateBlock { uint candidates[]; };

uniform uint triangleCount;
uniform int verticesPerTriangle;

// The invocation's triangle; there is none from `triangleCount` on.
uint invocationTriangle() {
  return gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
}

void addCandidate(uint triangle) {
  uint vertex = atomicAdd(brickWork.vertexCount, uint(verticesPerTriangle));
  candidates[vertex / uint(verticesPerTriangle)] = triangle;
}
