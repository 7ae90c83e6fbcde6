// The second level: the range of depths of each block of texels, over all layers (Buerger et al. 2007, section 1.3). One
// layer per dispatch, one invocation per block.
#include "shared/passes/depth_cube.h"
#include "tracing/depth_cube/cube.glsl"

layout(local_size_x = 64) in;
layout(binding = UNIT_CUBE_DEPTHS) uniform sampler2DArray cubeDepths;
layout(std430, binding = SSBO_CUBE_BLOCKS) buffer BlockBlock { vec2 blockDepths[]; };
layout(std430, binding = SSBO_CUBE_COUNTS) readonly buffer CountBlock { uint sampleCounts[]; };
uniform int layer;
uniform int layerCount;

void main() {
  uint index = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  uint perAxis = uint(blocksAlong()) * uint(blocksAlong());
  if (index >= 3u * perAxis) return;
  int axis = int(index / perAxis), number = int(index % perAxis);
  ivec2 first = ivec2(number % blocksAlong(), number / blocksAlong()) * blockSize;
  ivec2 size = min(first + blockSize, ivec2(bufferResolution)) - first;
  vec2 range = layer == 0 ? vec2(CUBE_NO_SAMPLE, -1.0) : blockDepths[index];
  for (int i = 0; i < size.x * size.y; ++i) {
    ivec2 texel = first + ivec2(i % size.x, i / size.x);
    float depth = texelFetch(cubeDepths, ivec3(cubeTexel(axis, texel), layer), 0).x;
    if (depth < CUBE_NO_SAMPLE) range = vec2(min(range.x, depth), max(range.y, depth));
    // What lies behind the last layer may be anywhere behind it.
    if (layer == layerCount - 1 && sampleCounts[headIndex(axis, texel)] > uint(layerCount)) range.y = CUBE_NO_SAMPLE;
  }
  blockDepths[index] = range;
}
