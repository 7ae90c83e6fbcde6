// The box of bricks that are not empty any more, and the bricks whose empty cubes of each size may reach it. One
// invocation.
#include "shared/passes/identity.h"
#include "tracing/common/grid.glsl"
#include "tracing/identity/brick_work.glsl"

layout(local_size_x = 1) in;

void main() {
  ivec3 count = voxelCount >> BRICK_SHIFT;
  ivec3 below = ivec3(brickWork.filledBelowX, brickWork.filledBelowY, brickWork.filledBelowZ);
  ivec3 high = ivec3(brickWork.filledAboveX, brickWork.filledAboveY, brickWork.filledAboveZ);
  ivec3 low = FILLED_BELOW - below;
  brickWork.boundLowX = uint(low.x);
  brickWork.boundLowY = uint(low.y);
  brickWork.boundLowZ = uint(low.z);
  brickWork.boundHighX = uint(high.x);
  brickWork.boundHighY = uint(high.y);
  brickWork.boundHighZ = uint(high.z);
  for (int power = 0; power < MAX_EMPTY_SIDE; ++power) {
    int reach = (2 << power) - 1;
    ivec3 size = high.x > 0 ? min(high + reach, count) - max(low - reach, 0) : ivec3(0);
    ivec3 side = ivec3(BOUND_GROUP_X, BOUND_GROUP_YZ, BOUND_GROUP_YZ), groups = (size + side - 1) / side;
    brickWork.boundGroups[3 * power] = uint(groups.x);
    brickWork.boundGroups[3 * power + 1] = uint(groups.y);
    brickWork.boundGroups[3 * power + 2] = uint(groups.z);
  }
  brickWork.filledBelowX = brickWork.filledBelowY = brickWork.filledBelowZ = 0u;
  brickWork.filledAboveX = brickWork.filledAboveY = brickWork.filledAboveZ = 0u;
}
