#include "tracing/attributes/search.glsl"
#include "tracing/common/trace_fragment.glsl"
