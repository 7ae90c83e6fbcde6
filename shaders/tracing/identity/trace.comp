#include "tracing/identity/search.glsl"
#include "tracing/common/trace_compute.glsl"
