// States of all bricks before any is built: empty, or missing if the voxel pass found triangles. Empty cubes are as
// large as they can be until they are bounded. One invocation per brick.
#include "shared/passes/identity.h"
#include "tracing/common/voxel_store.glsl"
#include "tracing/identity/bricks.glsl"

layout(local_size_x = 64) in;
uniform uint brickCount;

void main() {
  uint brick = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (brick < brickCount) bricks[brick] = voxelMaskAt(brick) != 0u ? BRICK_MISSING : BRICK_EMPTY + MAX_EMPTY_SIDES;
}
