// Begins a build of the bricks that rays have asked for: how much its steps have to do, which is nothing if there are
// no requests. While runs wait for room, requests wait, too. One invocation.
#include "shared/passes/identity.h"
#include "shared/passes/listed_triangles.h"
#include "tracing/common/listed_triangles.glsl"
#include "tracing/identity/brick_work.glsl"

layout(local_size_x = 1) in;
uniform uint maxRequests;
uniform uint blockCount;  // of triangles

// In rows; see dispatchFor().
uvec3 rowsOf(uint groups) {
  return uvec3(min(groups, MAX_TRIANGLE_GROUPS), (groups + MAX_TRIANGLE_GROUPS - 1u) / MAX_TRIANGLE_GROUPS, 1u);
}

// Of 64 invocations each.
uvec3 groupsFor(uint items) { return rowsOf((items + 63u) / 64u); }

void main() {
  bool room = brickWork.waitingWords == 0u;
  uint count = room ? min(brickWork.requestedBricks, maxRequests) : 0u;
  if (room) brickWork.requestedBricks = brickWork.fewGroupsX = brickWork.heavyBricks = 0u;
  brickWork.buildCount = count;
  brickWork.buildWords = 0u;
  brickWork.firstWord = brickWork.nextWord = brickWork.usedWords;
  uvec3 groups = groupsFor(count > 0u ? blockCount : 0u);
  brickWork.blockGroupsX = groups.x;
  brickWork.blockGroupsY = groups.y;
  brickWork.blockGroupsZ = groups.z;
  brickWork.triangleGroupsX = 0u;  // counted up
  brickWork.triangleGroupsY = brickWork.triangleGroupsZ = 1u;
  brickWork.wantedBlocks = 0u;
  groups = groupsFor(count);
  brickWork.buildGroupsX = groups.x;
  brickWork.buildGroupsY = groups.y;
  brickWork.buildGroupsZ = groups.z;
  groups = rowsOf(count);
  brickWork.groupsPerBuildX = groups.x;
  brickWork.groupsPerBuildY = groups.y;
  brickWork.groupsPerBuildZ = groups.z;
  groups = rowsOf(count <= MAX_PAIRED_BRICKS ? count : 0u);
  brickWork.pairGroupsX = groups.x;
  brickWork.pairGroupsY = groups.y;
  brickWork.pairGroupsZ = groups.z;
  listed.largeVertices = listed.pairedCount = 0u;
  listed.smallGroupsX = 0u;
  listed.smallCount = 0u;
}
