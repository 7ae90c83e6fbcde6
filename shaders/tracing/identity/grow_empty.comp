// Doubles the empty cubes that empty bricks begin: a cube is empty if the eight half as large in it are. What lies
// beyond the grid is empty, too. In place, since sides only grow. One invocation per brick of a box: cubes that begin
// beyond it are as they were, and are read.
#include "shared/passes/identity.h"
#include "tracing/identity/brick_work.glsl"
#include "tracing/identity/bricks.glsl"

layout(local_size_x = GROW_GROUP_X, local_size_y = GROW_GROUP_YZ, local_size_z = GROW_GROUP_YZ) in;
uniform int power;  // sides of 2^power bricks that are to be doubled

// The directions, as bits, in which the brick begins an empty cube of that side.
uint emptyOctants(ivec3 brick) {
  ivec3 count = voxelCount >> BRICK_SHIFT;
  if (any(lessThan(brick, ivec3(0))) || any(greaterThanEqual(brick, count))) return 0xffu;
  uint state = bricks[brickIndex(brick)];
  if (!emptyBrick(state)) return 0u;
  uint octants = 0u;
  for (uint o = 0u; o < 8u; ++o) {
    if (((state >> (EMPTY_SIDE_BITS * o)) & 7u) >= uint(power)) octants |= 1u << o;
  }
  return octants;
}

void main() {
  uvec3 low = uvec3(brickWork.growLowX, brickWork.growLowY, brickWork.growLowZ);
  uvec3 size = uvec3(brickWork.growSizeX, brickWork.growSizeY, brickWork.growSizeZ);
  if (any(greaterThanEqual(gl_GlobalInvocationID, size))) return;
  ivec3 brick = ivec3(low + gl_GlobalInvocationID);
  uint index = brickIndex(brick), state = bricks[index];
  if (!emptyBrick(state)) return;
  uint octants = emptyOctants(brick);
  for (int i = 0; i < 27; ++i) {
    ivec3 step = ivec3(i % 3, i / 3 % 3, i / 9) - 1;
    // The directions that this neighbor lies in; a step of 0 lies in both.
    uint x = step.x > 0 ? 0xaau : (step.x < 0 ? 0x55u : 0xffu);
    uint y = step.y > 0 ? 0xccu : (step.y < 0 ? 0x33u : 0xffu);
    uint z = step.z > 0 ? 0xf0u : (step.z < 0 ? 0x0fu : 0xffu);
    octants &= ~(x & y & z) | emptyOctants(brick + (step << power));
  }
  // The first doubling knows nothing of earlier cubes, into which triangles may have moved.
  if (power == 0) state = BRICK_EMPTY;
  for (uint o = 0u; o < 8u; ++o) {
    if ((octants >> o & 1u) != 0u) state += 1u << (EMPTY_SIDE_BITS * o);
  }
  bricks[index] = state;
}
