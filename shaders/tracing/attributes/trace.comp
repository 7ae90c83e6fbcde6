#include "tracing/attributes/search.glsl"
#include "tracing/common/trace_compute.glsl"
