// The queue of a trace: its rays and their hits. A dispatch goes over all rays, or over those that the last one left
// waiting, which are listed: a driver may end loops early, and a structure that is built on demand may lack something.
#include "lib/frame.glsl"
#include "lib/queued_ray.glsl"
#include "shared/bindings.h"
#include "shared/passes/trace.h"
#include "shared/rays.h"
#include "shared/structs.h"
#include "tracing/common/grid.glsl"
#include "tracing/common/ray_triangle.glsl"
#include "tracing/common/trace_state.glsl"
#include "tracing/common/walk.glsl"

layout(std430, binding = SSBO_RAY_COUNT) coherent buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_HITS) buffer HitBlock { Hit hits[]; };
layout(std430, binding = SSBO_PAUSED) buffer PausedBlock { PausedRay paused[]; };
// Two lists of rays in turn, one that this dispatch reads and one that it writes.
layout(std430, binding = SSBO_RESUME) buffer ResumeBlock {
  Resume resume;
  uint waiting[];
};

// Rays that this dispatch has to trace, and the index of one of them.
uint raysToTrace() { return resuming == 1 ? resume.count : rayCount.count; }
uint rayToTrace(uint number) { return resuming == 1 ? waiting[resume.readFrom + number] : number; }

TraceRay loadRay(uint index) {
  Ray queued = queuedRay(index, rayCount.source);
  TraceRay ray;
  ray.origin = queued.origin;
  ray.direction = queued.direction;
  ray.gridOrigin = toGrid(ray.origin);
  ray.gridDirection = ray.direction * gridInverse;
  ray.excluded = queued.excluded;
  vec3 size = abs(ray.origin);
  ray.least = min(NEAREST_SHARE * max(size.x, max(size.y, size.z)), frame.minDistance);
  ray.most = queued.maxDistance;
  ray.shear = makeShear(ray.direction);
  return ray;
}

PausedRay loadPause(uint index) {
  PausedRay none = PausedRay(0.0, 0u, 0u, 0u);
  return resuming == 1 ? paused[index] : none;
}

void pauseRay(uint index, PausedRay pause) {
  paused[index] = pause;
  waiting[resume.writeTo + atomicAdd(rayCount.unfinished, 1u)] = index;
}

// The ray's result. `complete`: its way has been searched to the end. Returns it as stored.
Hit storeHit(uint index, TraceRay ray, Hit best, bool complete) {
  if (best.t > ray.most || best.t == farAway) best = Hit(HIT_MISS, NO_TRIANGLE, 0.0, 0.0);
  if (!complete) {
    atomicAdd(rayCount.overflow, 1u);
    best = Hit(HIT_OVERFLOW, NO_TRIANGLE, 0.0, 0.0);
  }
  hits[index] = best;
  return best;
}
