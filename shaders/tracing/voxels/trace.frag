#include "tracing/voxels/search.glsl"
#include "tracing/common/trace_fragment.glsl"
