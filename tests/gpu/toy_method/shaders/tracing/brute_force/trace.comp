#include "tracing/brute_force/search.glsl"
#include "tracing/common/trace_compute.glsl"
