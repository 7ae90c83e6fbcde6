// Moves the runs that are there together, into another buffer, in any order. One invocation per brick.
#include "shared/passes/identity.h"
#include "tracing/identity/brick_work.glsl"
#include "tracing/identity/bricks.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = SSBO_COMPACTED_RUNS) writeonly buffer MovedBlock { uint moved[]; };
uniform uint brickCount;

void main() {
  uint brick = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (brick >= brickCount) return;
  uint run = bricks[brick];
  if (!present(run)) return;
  uint words = runWords(run), place = atomicAdd(brickWork.usedWords, words);
  for (uint i = 0u; i < words; ++i) moved[place + i] = runs[run + i];
  bricks[brick] = place;
}
