// The most samples that a texel has, by halving within a group and an atomic between them, and the build's counts.
#include "shared/passes/depth_cube.h"
#include "shared/tracing.h"
#include "tracing/common/counters.glsl"
#include "tracing/common/grid.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = SSBO_CUBE_COUNTS) readonly buffer CountBlock { uint sampleCounts[]; };
uniform uint maxLayers;

shared uint deepest[64];

void main() {
  uint index = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  uint local = gl_LocalInvocationID.x;
  uint count = index < uint(sampleCounts.length()) ? sampleCounts[index] : 0u;
  deepest[local] = count;
  for (uint left = 32u; left > 0u; left /= 2u) {
    barrier();
    if (local < left) deepest[local] = max(deepest[local], deepest[local + left]);
  }
  if (local == 0u) atomicMax(counters[COUNTER_DEEPEST], deepest[0]);
  ivec2 slot = ivec2(index, index >> 3);
  uint axis = min(2u, index / (uint(bufferResolution) * uint(bufferResolution)));
  countAt(COUNTER_FRAGMENTS, slot, count);
  countAt(COUNTER_STORED_X + axis, slot, min(count, maxLayers));
  countAt(COUNTER_LOST, slot, count - min(count, maxLayers));
}
