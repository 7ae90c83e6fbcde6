// What the search of a ray did, for benchmarks: with COUNT_WORK, steps and tests are counted over all dispatches. Without
// it, nothing is left of this.
#include "shared/passes/trace.h"
#include "shared/rays.h"
#include "tracing/common/trace_state.glsl"

#ifdef COUNT_WORK
layout(std430, binding = SSBO_RAY_WORK) buffer RayWorkBlock { RayWork rayWork[]; };
uint stepsDone = 0u, testsDone = 0u;
void countStep() { ++stepsDone; }
void countTest() { ++testsDone; }
void keepWork(uint index) {
  RayWork before = rayWork[index];
  if (resuming == 0) before = RayWork(0u, 0u);
  rayWork[index] = RayWork(before.steps + stepsDone, before.tests + testsDone);
  stepsDone = testsDone = 0u;
}
#else
void countStep() {}
void countTest() {}
void keepWork(uint index) {}
#endif
