// The layered depth cube (Buerger et al. 2007, section 1.1): for each axis a stack of images, in which every texel
// holds a depth per layer, nearest first. The images of the three axes lie side by side.
#include "shared/passes/depth_cube.h"
#include "tracing/common/grid.glsl"
#include "tracing/common/packed_unit.glsl"

uniform int blockSize;  // texels along each side

int blocksAlong() { return (bufferResolution + blockSize - 1) / blockSize; }
uint blockIndex(int axis, ivec2 block) {
  return (uint(axis) * uint(blocksAlong()) + uint(block.y)) * uint(blocksAlong()) + uint(block.x);
}

// Of an axis' texel in the images side by side, and back.
ivec2 cubeTexel(int axis, ivec2 texel) { return texel + ivec2(axis * bufferResolution, 0); }
int axisOfTexel(ivec2 place) { return place.x / bufferResolution; }
