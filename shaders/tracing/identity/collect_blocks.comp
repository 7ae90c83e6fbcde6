// Lists the blocks of triangles that a requested brick lies in. One invocation per block.
#include "shared/passes/identity.h"
#include "shared/passes/listed_triangles.h"
#include "tracing/identity/brick_work.glsl"
#include "tracing/identity/requested_box.glsl"
#include "tracing/identity/triangle_blocks.glsl"

layout(local_size_x = 64) in;
// Larger blocks are listed without a look at their bricks.
const float maxBricks = 512.0;

uniform uint triangleBlockCount;

void main() {
  uint block = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (block >= triangleBlockCount) return;
  BrickBox box = boxOfBlock(block);
  if (!requestedIn(box.low, box.high, maxBricks)) return;
  uint number = atomicAdd(brickWork.wantedBlocks, 1u);
  if (number < MAX_TRIANGLE_GROUPS) atomicAdd(brickWork.triangleGroupsX, 1u);
  triangleBlocks[number].wanted = block;
}
