// Counts the samples of each texel: the most that one has is the number of passes that peeling takes. Compiled with CUT
// for materials with holes.
#ifdef CUT
#include "lib/alpha.glsl"
#include "lib/scene.glsl"
#endif
#include "shared/passes/depth_cube.h"
#include "tracing/common/grid.glsl"

layout(std430, binding = SSBO_CUBE_COUNTS) buffer CountBlock { uint sampleCounts[]; };

layout(location = 0) flat in uint inTriangle;
layout(location = 1) in vec3 inBarycentricsDepth;

void main() {
#ifdef CUT
  if (cutAway(inTriangle, inBarycentricsDepth.xy)) return;
#endif
  ivec2 place = ivec2(gl_FragCoord.xy);
  atomicAdd(sampleCounts[headIndex(place.x / bufferResolution, ivec2(place.x % bufferResolution, place.y))], 1u);
}
