// Blocks of consecutive triangles with the boxes of bricks that they lie in, so that a build looks at those alone that
// a requested brick lies in.
#include "shared/passes/identity.h"
#include "tracing/common/grid.glsl"

struct BoundedBlock {
  uint low, high;  // bricks, inclusive: ten bits per axis
  uint wanted;     // a number of a block: the list of those that the build under way looks at
};
layout(std430, binding = SSBO_TRIANGLE_BLOCKS) buffer BoundedBlockBlock { BoundedBlock triangleBlocks[]; };

uint packBrick(ivec3 brick) { return uint(brick.x) | uint(brick.y) << 10 | uint(brick.z) << 20; }
ivec3 unpackBrick(uint word) { return ivec3(word & 1023u, word >> 10 & 1023u, word >> 20); }

// A box of bricks, inclusive.
struct BrickBox {
  ivec3 low, high;
};

// Of the bricks that a triangle may touch: the box of its corners, with slack beyond that of the test that decides.
// `a`, `b`, `c` in world space; `count` along each axis.
BrickBox bricksOf(vec3 a, vec3 b, vec3 c, ivec3 count) {
  vec3 first = toGrid(a) * vec3(count), second = toGrid(b) * vec3(count), third = toGrid(c) * vec3(count);
  ivec3 low = ivec3(floor(min(first, min(second, third)) - 0.05));
  ivec3 high = ivec3(floor(max(first, max(second, third)) + 0.05));
  return BrickBox(clamp(low, ivec3(0), count - 1), clamp(high, ivec3(0), count - 1));
}

// The same if the grid is that of voxels.
BrickBox bricksOf(vec3 a, vec3 b, vec3 c) { return bricksOf(a, b, c, voxelCount / BRICK_SIDE); }

bool holds(BrickBox box, ivec3 brick) {
  return all(lessThanEqual(box.low, brick)) && all(lessThanEqual(brick, box.high));
}

BrickBox boxOfBlock(uint block) {
  return BrickBox(unpackBrick(triangleBlocks[block].low), unpackBrick(triangleBlocks[block].high));
}

// Whether a brick, packed, lies in a block's box. All axes at once: their differences leave the bits above them set.
bool blockHolds(uint block, uint brick) {
  const uint above = 0x20080200u;
  return (((brick | above) - triangleBlocks[block].low) & ((triangleBlocks[block].high | above) - brick) & above) == above;
}
