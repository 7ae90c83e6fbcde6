// Tracing of one ray of the queue. The method's search.glsl defines march() and storeSurface(); its entry points
// trace.comp and trace.frag share every line (tests hold them to the same bits).
#include "lib/frame.glsl"
#include "lib/queued_ray.glsl"
#include "shared/bindings.h"
#include "shared/passes/trace.h"
#include "shared/rays.h"
#include "shared/structs.h"
#include "shared/tracing.h"
#include "tracing/common/grid.glsl"
#include "tracing/common/ray_triangle.glsl"
#include "tracing/common/ray_work.glsl"
#include "tracing/common/trace_state.glsl"
#include "tracing/common/walk.glsl"

layout(std430, binding = SSBO_RAY_COUNT) coherent buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_HITS) buffer HitBlock { Hit hits[]; };
layout(std430, binding = SSBO_PAUSED) buffer PausedBlock { PausedRay paused[]; };

// Finds the nearest hit before `end`. False if the ray is not through; `pause` then says how to go on.
bool march(TraceRay ray, float end, inout PausedRay pause, inout Hit best);
// Writes HitSurface, if the method stores attributes.
void storeSurface(uint index, Hit hit);

void traceRay(uint index) {
  PausedRay pause = PausedRay(0.0, 0u, 0u, 0u);
  if (resuming == 1) {
    if (hits[index].triangle != UNFINISHED_TRIANGLE) return;
    pause = paused[index];
  }
  Ray queued = queuedRay(index, rayCount.source);
  TraceRay ray;
  ray.origin = queued.origin;
  ray.direction = queued.direction;
  ray.gridOrigin = toGrid(ray.origin);
  ray.gridDirection = ray.direction * gridInverse;
  ray.excluded = queued.excluded;
  ray.least = frame.minDistance;
  ray.shear = makeShear(ray.direction);

  Hit best = Hit(farAway, NO_TRIANGLE, 0.0, 0.0);
  vec2 range = gridRange(ray);
  pause.t = max(range.x, pause.t);
  bool through = march(ray, min(range.y, queued.maxDistance), pause, best);
  keepWork(index);
  if (!through) {
    if (lastDispatch == 0) {
      hits[index] = Hit(HIT_NOT_TRACED, UNFINISHED_TRIANGLE, 0.0, 0.0);
      paused[index] = pause;
      atomicAdd(rayCount.unfinished, 1u);
      return;
    }
    incomplete = true;
  }
  if (incomplete) {
    atomicAdd(rayCount.overflow, 1u);
    best = Hit(HIT_OVERFLOW, NO_TRIANGLE, 0.0, 0.0);
  }
  if (best.t > queued.maxDistance || best.t == farAway) best = Hit(HIT_MISS, NO_TRIANGLE, 0.0, 0.0);
  hits[index] = best;
  storeSurface(index, best);
}
