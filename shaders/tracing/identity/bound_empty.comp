// Shrinks the empty cubes that empty bricks begin where they are not empty: one of 2^(power + 1) bricks is, if the eight
// half as large in it are. What lies beyond the grid is empty, too. In place, smaller cubes first: a step only takes
// sides down to 2^power, which the sides that it asks for are either way. One invocation per brick from which a cube of
// that size reaches bricks that are not empty any more.
#include "shared/passes/identity.h"
#include "tracing/identity/brick_work.glsl"
#include "tracing/identity/bricks.glsl"

layout(local_size_x = BOUND_GROUP_X, local_size_y = BOUND_GROUP_YZ, local_size_z = BOUND_GROUP_YZ) in;
uniform int power;

// Directions as sets: the lowest bit of each one's place in a state.
const uint allDirections = 0x249249u;
const uint toHighX = 0x208208u, toHighY = 0x240240u, toHighZ = 0x249000u;

// Those in which an empty brick begins an empty cube of at least 2^least bricks, at most 2^4.
uint emptyDirections(uint state, int least) {
  uint low = state, middle = state >> 1, high = state >> 2;
  uint found = least == 1 ? low | middle | high : (least == 2 ? middle | high : (least == 3 ? low & middle | high : high));
  return allDirections & (least == 0 ? allDirections : found);
}

uint directionsAt(ivec3 brick, int least) {
  ivec3 count = voxelCount >> BRICK_SHIFT;
  if (any(lessThan(brick, ivec3(0))) || any(greaterThanEqual(brick, count))) return allDirections;
  uint state = bricks[brickIndex(brick)];
  return emptyBrick(state) ? emptyDirections(state, least) : 0u;
}

// The directions that a step along an axis lies in; one of 0 lies in both.
uint along(int step, uint toHigh) {
  return step > 0 ? toHigh : (step < 0 ? allDirections & ~toHigh : allDirections);
}

void main() {
  int reach = (2 << power) - 1;
  ivec3 low = max(ivec3(brickWork.boundLowX, brickWork.boundLowY, brickWork.boundLowZ) - reach, 0);
  ivec3 high = min(ivec3(brickWork.boundHighX, brickWork.boundHighY, brickWork.boundHighZ) + reach,
                   voxelCount >> BRICK_SHIFT);
  ivec3 brick = low + ivec3(gl_GlobalInvocationID);
  if (any(greaterThanEqual(brick, high))) return;
  uint index = brickIndex(brick), state = bricks[index];
  uint before = emptyBrick(state) ? emptyDirections(state, power + 1) : 0u, after = before;
  for (int i = 0; i < 27 && after != 0u; ++i) {
    ivec3 step = ivec3(i % 3, i / 3 % 3, i / 9) - 1;
    uint directions = along(step.x, toHighX) & along(step.y, toHighY) & along(step.z, toHighZ);
    after &= ~directions | directionsAt(brick + (step << power), power);
  }
  uint smaller = before & ~after;
  if (smaller != 0u) bricks[index] = state & ~(7u * smaller) | uint(power) * smaller;
}
