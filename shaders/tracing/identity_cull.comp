// Collects triangles as an indirect draw: those that may touch a requested voxel, or (MOVED) those with a moved vertex.
// One invocation a triangle.
#include "shared/bindings.h"
#include "shared/structs.h"
#include "lib/frame.glsl"
#include "lib/scene.glsl"
#include "tracing/grid.glsl"
#ifndef MOVED
#define REQUEST_ACCESS readonly
#include "tracing/requested_voxels.glsl"
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
const int mostWords = 4096;

// Whether any voxel of a row is requested; `first` and `last` are numbers of voxels.
bool requestedBetween(uint first, uint last) {
  bool found = false;
  for (uint word = first >> 5; word <= last >> 5 && !found; ++word) {
    uint mask = 0xffffffffu;
    if (word == first >> 5) mask &= 0xffffffffu << (first & 31u);
    if (word == last >> 5) mask &= 0xffffffffu >> (31u - (last & 31u));
    found = (requestedWords[word] & mask) != 0u;
  }
  return found;
}

bool wantedTriangle(uint triangle) {
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  a = toGrid(a) * vec3(voxelCount);
  b = toGrid(b) * vec3(voxelCount);
  c = toGrid(c) * vec3(voxelCount);
  // Slack beyond that of the fragments, which decide.
  ivec3 low = clamp(ivec3(floor(min(a, min(b, c)) - 0.05)), ivec3(0), voxelCount - 1);
  ivec3 high = clamp(ivec3(floor(max(a, max(b, c)) + 0.05)), ivec3(0), voxelCount - 1);
  ivec3 size = high - low + 1;
  bool wanted = float(size.x / 32 + 2) * float(size.y) * float(size.z) > float(mostWords);
  for (int z = low.z; z <= high.z && !wanted; ++z)
    for (int y = low.y; y <= high.y && !wanted; ++y)
      wanted = requestedBetween(voxelIndex(ivec3(low.x, y, z)), voxelIndex(ivec3(high.x, y, z)));
  return wanted;
}
#endif

void main() {
  uint triangle = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (triangle >= triangleCount || !wantedTriangle(triangle)) return;
  candidates[atomicAdd(listBuild.vertexCount, uint(verticesPerTriangle)) / uint(verticesPerTriangle)] = triangle;
}
