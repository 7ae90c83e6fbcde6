// The box of bricks whose empty cubes may reach bricks that are not empty any more. One invocation.
#include "shared/passes/identity.h"
#include "tracing/common/grid.glsl"
#include "tracing/identity/brick_work.glsl"

layout(local_size_x = 1) in;

void main() {
  ivec3 count = voxelCount >> BRICK_SHIFT;
  ivec3 below = ivec3(brickWork.filledBelowX, brickWork.filledBelowY, brickWork.filledBelowZ);
  ivec3 above = ivec3(brickWork.filledAboveX, brickWork.filledAboveY, brickWork.filledAboveZ);
  const int reach = (1 << MAX_EMPTY_SIDE) - 1;
  ivec3 low = max(FILLED_BELOW - below - reach, 0), high = min(above + reach, count);
  ivec3 size = above.x > 0 ? high - low : ivec3(0);
  brickWork.growLowX = uint(low.x);
  brickWork.growLowY = uint(low.y);
  brickWork.growLowZ = uint(low.z);
  brickWork.growSizeX = uint(size.x);
  brickWork.growSizeY = uint(size.y);
  brickWork.growSizeZ = uint(size.z);
  uvec3 groups = (uvec3(size) + uvec3(GROW_GROUP_X, GROW_GROUP_YZ, GROW_GROUP_YZ) - 1u) /
                 uvec3(GROW_GROUP_X, GROW_GROUP_YZ, GROW_GROUP_YZ);
  brickWork.growGroupsX = groups.x;
  brickWork.growGroupsY = groups.y;
  brickWork.growGroupsZ = groups.z;
  brickWork.filledBelowX = brickWork.filledBelowY = brickWork.filledBelowZ = 0u;
  brickWork.filledAboveX = brickWork.filledAboveY = brickWork.filledAboveZ = 0u;
}
