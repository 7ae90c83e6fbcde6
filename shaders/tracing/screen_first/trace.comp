#include "tracing/screen_first/search.glsl"
#include "tracing/common/trace_compute.glsl"
