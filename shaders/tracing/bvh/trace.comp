#include "tracing/bvh/search.glsl"
#include "tracing/common/trace_compute.glsl"
