// Bindings that the trace programs of all methods share: tracing/common/trace_ray.glsl. A method's own begin at 11.
#ifndef HALFSILVER_PASSES_TRACE_H
#define HALFSILVER_PASSES_TRACE_H

#define SSBO_HIT_SURFACES 9  // HitSurface[], if the method stores attributes
#define SSBO_PAUSED 10       // PausedRay[]

#endif
