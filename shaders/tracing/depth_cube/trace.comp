#include "tracing/depth_cube/search.glsl"
#include "tracing/common/trace_compute.glsl"
