// Tracing of one ray of the queue. The method's search.glsl defines march() and storeSurface(); its entry points
// trace.comp and trace.frag share every line (tests hold them to the same bits).
#include "shared/rays.h"
#include "tracing/common/ray_queue.glsl"
#include "tracing/common/ray_work.glsl"
#include "tracing/common/trace_state.glsl"
#include "tracing/common/walk.glsl"

// Finds the nearest hit before `end`. False if the ray is not through; `pause` then says how to go on.
bool march(TraceRay ray, float end, inout PausedRay pause, inout Hit best);
// Writes HitSurface, if the method stores attributes.
void storeSurface(uint index, Hit hit);

// The ray with that number among those of the dispatch.
void traceRay(uint number) {
  uint index = rayToTrace(number);
  TraceRay ray = loadRay(index);
  PausedRay pause = loadPause(index);
  Hit best = Hit(farAway, NO_TRIANGLE, 0.0, 0.0);
  vec2 range = gridRange(ray);
  pause.t = max(range.x, pause.t);
  bool through = march(ray, min(range.y, ray.most), pause, best);
  keepWork(index);
  if (!through && lastDispatch == 0)
    pauseRay(index, pause);
  else
    storeSurface(index, storeHit(index, ray, best, through && !incomplete));
}
