// Bindings that the trace programs of all methods share: tracing/common/trace_ray.glsl. A method's own begin at 11.
#ifndef HALFSILVER_PASSES_TRACE_H
#define HALFSILVER_PASSES_TRACE_H

#define SSBO_RAY_WORK 4      // RayWork[], if it is counted; a trace reads no lights
#define SSBO_HIT_SURFACES 9  // HitSurface[], if the method stores attributes
#define SSBO_PAUSED 10       // PausedRay[]
#define SSBO_RESUME 6        // Resume, then two lists of ray indices; a trace reads no paths

// Invocations per group of dispatches over rays.
#define TRACE_GROUP 64

// The next dispatch of a trace, over the rays that the last one left: nothing if all are through.
struct Resume {
  uint vertices;  // an indirect draw: the stage is fragments
  uint instances;
  uint firstVertex;
  uint firstInstance;
  uint groupsX;  // an indirect dispatch
  uint groupsY;
  uint groupsZ;
  uint times;     // that there was something left
  uint count;     // of rays to trace
  uint readFrom;  // where their list begins
  uint writeTo;   // where the list of those that this dispatch leaves begins
  uint padding;
};

#endif
