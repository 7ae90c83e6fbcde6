// Sums up the words of each run that is there; moves it behind those before it, into another buffer.
#include "shared/passes/identity.h"
#include "tracing/identity/bricks.glsl"
#include "tracing/identity/prefix_sum.glsl"

layout(std430, binding = SSBO_COMPACTED_RUNS) writeonly buffer MovedBlock { uint moved[]; };

uint valueOf(uint item) { return present(bricks[item]) ? runWords(bricks[item]) : 0u; }

void store(uint item, uint sum) {
  uint run = bricks[item];
  if (!present(run)) return;
  uint words = runWords(run);
  for (uint i = 0u; i < words; ++i) moved[sum + i] = runs[run + i];
  bricks[item] = sum;
}
