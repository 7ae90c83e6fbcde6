#include "tracing/planar/search.glsl"
#include "tracing/common/trace_compute.glsl"
