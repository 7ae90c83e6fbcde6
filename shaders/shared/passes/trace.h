// Bindings that the trace programs of all methods share: tracing/common/trace_ray.glsl. A method's own begin at 11.
#ifndef HALFSILVER_PASSES_TRACE_H
#define HALFSILVER_PASSES_TRACE_H

#define SSBO_RAY_WORK 4      // RayWork[], if it is counted; a trace reads no lights
#define SSBO_HIT_SURFACES 9  // HitSurface[], if the method stores attributes
#define SSBO_PAUSED 10       // PausedRay[]
#define SSBO_RESUME 6        // Resume; a trace reads no paths

// The next dispatch of a trace: nothing if all rays are through.
struct Resume {
  uint vertices;  // an indirect draw: the stage is fragments
  uint instances;
  uint firstVertex;
  uint firstInstance;
  uint groupsX;  // an indirect dispatch
  uint groupsY;
  uint groupsZ;
  uint times;  // that there was something left
};

#endif
