// Counters of a build (see shared/tracing.h).
#include "shared/passes/build_counters.h"
#include "shared/tracing.h"

layout(std430, binding = SSBO_COUNTERS) coherent buffer CounterBlock { uint counters[]; };

void countAt(uint kind, ivec2 texel, uint number) {
  uint slot = uint(texel.x & 7) + uint(texel.y & 7) * 8u;
  if (number > 0u) atomicAdd(counters[slot * COUNTER_KINDS + kind], number);
}

void countAt(uint kind, ivec2 texel) { countAt(kind, texel, 1u); }
