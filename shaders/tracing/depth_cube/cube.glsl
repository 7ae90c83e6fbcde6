// The layered depth cube (Buerger et al. 2007, section 1.1): for each axis a stack of images, in which every texel
// holds a depth per layer, nearest first. The images of the three axes lie side by side.
#include "shared/passes/depth_cube.h"
#include "tracing/common/grid.glsl"

uniform int blockSize;  // texels along each side

int blocksAlong() { return (bufferResolution + blockSize - 1) / blockSize; }
uint blockIndex(int axis, ivec2 block) {
  return (uint(axis) * uint(blocksAlong()) + uint(block.y)) * uint(blocksAlong()) + uint(block.x);
}

// Of an axis' texel in the images side by side, and back.
ivec2 cubeTexel(int axis, ivec2 texel) { return texel + ivec2(axis * bufferResolution, 0); }
int axisOfTexel(ivec2 place) { return place.x / bufferResolution; }

// A unit vector in 32 bits: the octahedron's two coordinates (Meyer et al. 2010).
uint packUnit(vec3 v) {
  v /= abs(v.x) + abs(v.y) + abs(v.z);
  vec2 folded = (1.0 - abs(v.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(v.xy, vec2(0.0)));
  return packSnorm2x16(v.z >= 0.0 ? v.xy : folded);
}

vec3 unpackUnit(uint bits) {
  vec2 p = unpackSnorm2x16(bits);
  vec3 v = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  vec2 folded = (1.0 - abs(v.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(v.xy, vec2(0.0)));
  if (v.z < 0.0) v.xy = folded;
  return normalize(v);
}
