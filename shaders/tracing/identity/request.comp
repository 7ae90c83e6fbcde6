// Asks for the bricks that rays wait for, each for the one that it has come to and for the next ones on its way. One
// invocation per waiting ray.
#include "shared/passes/identity.h"
#include "shared/passes/trace.h"
#include "tracing/common/ray_queue.glsl"
#include "tracing/identity/brick_requests.glsl"
#include "tracing/identity/brick_work.glsl"
#include "tracing/identity/bricks.glsl"
#include "tracing/identity/voxel_walk.glsl"

layout(local_size_x = TRACE_GROUP) in;
uniform uint maxRequests;  // in one build
uniform int lookAhead;     // bricks with triangles

void requestBrick(uint brick) {
  if (atomicCompSwap(bricks[brick], BRICK_MISSING, BRICK_CLAIMED) != BRICK_MISSING) return;
  uint number = atomicAdd(brickWork.requestedBricks, 1u);
  bricks[brick] = number < maxRequests ? BRICK_REQUESTED + number : BRICK_MISSING;
  if (number >= maxRequests) return;
  requests[number].brick = brick;
  atomicAdd(brickWork.fewGroupsX, 1u);
}

void main() {
  uint number = (gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x) * TRACE_GROUP + gl_LocalInvocationID.x;
  if (number >= resume.count) return;
  uint index = waiting[resume.readFrom + number];
  TraceRay ray = loadRay(index);
  VoxelRay walk = makeVoxelRay(ray);
  uint octant = octantOf(walk);
  float end = min(gridRange(ray).y, ray.most);
  ivec3 voxel = resumedVoxel(walk, paused[index]);
  int left = lookAhead;
  // Rays that only ran out of iterations ask for nothing.
  uint here = bricks[brickIndex(brickOf(voxel))];
  bool going = !present(here) && !emptyBrick(here);
  while (going) {
    uint brick = brickIndex(brickOf(voxel)), state = bricks[brick];
    if (!emptyBrick(state)) --left;
    if (state == BRICK_MISSING) requestBrick(brick);
    Cube cube = emptyBrick(state) ? emptyCube(walk, octant, voxel, state) : brickCube(walk, voxel);
    voxel = voxelBehind(walk, cube);
    going = left > 0 && exitOf(cube) < end && inGrid(voxel);
  }
}
