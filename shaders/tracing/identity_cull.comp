// Collects triangles as an indirect draw: those that may touch a requested brick, or (MOVED) those with a moved vertex.
// One invocation a triangle.
#include "shared/bindings.h"
#include "shared/structs.h"
#include "lib/frame.glsl"
#include "lib/scene.glsl"
#include "tracing/grid.glsl"
#ifndef MOVED
#define RUN_ACCESS readonly
#include "tracing/bricks.glsl"
#endif

layout(local_size_x = 64) in;
layout(std430, binding = SSBO_LIST_BUILD) coherent buffer ListBuildBlock { ListBuild listBuild; };
layout(std430, binding = SSBO_LINKS) writeonly buffer CandidateBlock { uint candidates[]; };

uniform uint triangleCount;
uniform int verticesPerTriangle;

#ifdef MOVED
uniform uint firstVertex;
uniform uint vertexCount;

bool wantedTriangle(uint triangle) {
  uvec3 corners = triangleAt(triangle).xyz;
  return any(lessThan(corners - firstVertex, uvec3(vertexCount)));  // numbers below the first wrap around
}
#else
// Larger ones are taken unseen: their fragments are looked at anyway.
const int mostBricks = 4096;

bool wantedTriangle(uint triangle) {
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  ivec3 count = voxelCount / BRICK_SIDE;
  a = toGrid(a) * vec3(count);
  b = toGrid(b) * vec3(count);
  c = toGrid(c) * vec3(count);
  // Slack beyond that of the fragments, which decide.
  ivec3 low = clamp(ivec3(floor(min(a, min(b, c)) - 0.05)), ivec3(0), count - 1);
  ivec3 high = clamp(ivec3(floor(max(a, max(b, c)) + 0.05)), ivec3(0), count - 1);
  vec3 size = vec3(high - low + 1);
  bool wanted = size.x * size.y * size.z > float(mostBricks);
  for (int z = low.z; z <= high.z && !wanted; ++z)
    for (int y = low.y; y <= high.y && !wanted; ++y)
      for (int x = low.x; x <= high.x && !wanted; ++x) wanted = requested(bricks[brickIndex(ivec3(x, y, z))]);
  return wanted;
}
#endif

void main() {
  uint triangle = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (triangle >= triangleCount || !wantedTriangle(triangle)) return;
  candidates[atomicAdd(listBuild.vertexCount, uint(verticesPerTriangle)) / uint(verticesPerTriangle)] = triangle;
}
