#include "tracing/depth_cube/search.glsl"
#include "tracing/common/trace_fragment.glsl"
