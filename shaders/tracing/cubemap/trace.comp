#include "tracing/cubemap/search.glsl"
#include "tracing/common/trace_compute.glsl"
