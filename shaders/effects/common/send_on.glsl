// Rays of the next generation.
#include "shared/bindings.h"
#include "shared/passes/light_sums.h"
#include "shared/rays.h"

layout(std430, binding = SSBO_NEXT_RAYS) writeonly buffer NextRayBlock { Ray nextRays[]; };
layout(std430, binding = SSBO_NEXT_PATHS) writeonly buffer NextPathBlock { ScatteredPath nextPaths[]; };
layout(std430, binding = SSBO_NEXT_COUNT) buffer NextCountBlock { RayCount nextCount; };

uniform uint nextCapacity;

// What there is no room for is given up and counted.
void sendOn(Ray ray, ScatteredPath path) {
  uint next = atomicAdd(nextCount.count, 1u);
  if (next >= nextCapacity) {
    atomicAdd(nextCount.overflow, 1u);
    return;
  }
  atomicAdd(nextCount.byKind[path.kindAndSample & 255u], 1u);
  nextRays[next] = ray;
  nextPaths[next] = path;
}
