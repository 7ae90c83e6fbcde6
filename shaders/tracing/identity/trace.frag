#include "tracing/identity/search.glsl"
#include "tracing/common/trace_fragment.glsl"
