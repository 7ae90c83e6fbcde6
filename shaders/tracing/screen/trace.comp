#include "tracing/screen/search.glsl"
#include "tracing/common/trace_compute.glsl"
