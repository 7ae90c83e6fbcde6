#include "tracing/screen/search.glsl"
#include "tracing/common/trace_fragment.glsl"
