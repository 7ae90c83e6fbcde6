// A build of few bricks in one step: a group per brick finds the triangles that touch its voxels, counts them, places the
// run and fills it. The group that is through last says where the runs are, or, if there is no room for all of them,
// that they are missing again. A brick with too many triangles for a group is missing, too, and counted.
//
// More requests than MAX_FEW_BRICKS stay for a build in many steps, as do all while runs wait for room.
#define RUN_ACCESS coherent
#include "lib/triangles.glsl"
#include "shared/passes/identity.h"
#include "tracing/common/counters.glsl"
#include "tracing/common/projections.glsl"
#include "tracing/common/voxel_store.glsl"
#include "tracing/identity/brick_requests.glsl"
#include "tracing/identity/brick_voxels.glsl"
#include "tracing/identity/brick_work.glsl"
#include "tracing/identity/bricks.glsl"
#include "tracing/identity/entry.glsl"
#include "tracing/identity/entry_boxes.glsl"
#include "tracing/identity/triangle_blocks.glsl"

layout(local_size_x = TRIANGLE_BLOCK) in;
uniform uint triangleBlockCount;

// Blocks of triangles that are looked at together, and triangles that a group has room for. Software rasterizers stop
// long loops, so there is also a limit to the blocks whose triangles a group looks at.
const uint blocksTogether = 512u, maxTriangles = 2048u, maxBlocks = 16384u;

shared uint blockCount, blocks[blocksTogether];
shared uint touchCount, touching[maxTriangles];
shared uvec2 touched[maxTriangles];  // voxels of the brick, a bit each
shared uint next[VOXELS_PER_BRICK];  // as BrickBuild::next
shared uint run, runEnd, runEntries;
shared bool last;

uint lane = gl_LocalInvocationIndex;

// Lists the triangles whose boxes hold the brick. Their number may be larger than the list.
void listTriangles(ivec3 brick) {
  uint looked = 0u;
  for (uint first = 0u; first < triangleBlockCount; first += blocksTogether) {
    if (lane == 0u) blockCount = 0u;
    barrier();
    uint end = min(first + blocksTogether, triangleBlockCount);
    for (uint block = first + lane; block < end; block += TRIANGLE_BLOCK) {
      if (blockHolds(block, packBrick(brick))) blocks[atomicAdd(blockCount, 1u)] = block;
    }
    barrier();
    looked += blockCount;
    for (uint i = 0u; i < blockCount && looked <= maxBlocks; ++i) {
      uint triangle = blocks[i] * TRIANGLE_BLOCK + lane;
      if (triangle >= triangleCount) continue;
      vec3 a, b, c;
      trianglePositions(triangle, a, b, c);
      if (!holds(bricksOf(a, b, c), brick)) continue;
      uint place = atomicAdd(touchCount, 1u);
      if (place < maxTriangles) touching[place] = triangle;
    }
    barrier();
  }
  if (looked > maxBlocks) touchCount = maxTriangles + 1u;
}

// Counts the entries of the voxels.
void countEntries(ivec3 brick, uint brickNumber) {
  uvec3 entries = uvec3(0u);  // of the triangles of each axis
  for (uint i = lane; i < touchCount; i += TRIANGLE_BLOCK) {
    vec3 a, b, c;
    trianglePositions(touching[i], a, b, c);
    uvec2 voxels = uvec2(0u);
    for (int projection = 0; projection < projectionCount(); ++projection) {
      ProjectedTriangle t = projectTriangle(a, b, c, projection);
      // In the A-buffer of the brick's axis only, as in addEntry().
      if (ownAxis == 0 && (voxelMaskAt(brickNumber) & (1u << uint(t.axis))) == 0u) continue;
      voxels = touchedInBrick(t, brick);
      entries[t.axis] += uint(bitCount(voxels.x) + bitCount(voxels.y));
    }
    touched[i] = voxels;
    while (voxels != uvec2(0u)) atomicAdd(next[takeVoxel(voxels)], 1u);
  }
  for (uint axis = 0u; axis < 3u; ++axis) countAt(COUNTER_STORED_X + axis, ivec2(lane % 8u, lane / 8u), entries[axis]);
  countAt(COUNTER_FRAGMENTS, ivec2(lane % 8u, lane / 8u), entries.x + entries.y + entries.z);
}

// Finds the run's place and writes its header. One invocation.
void placeRun() {
  uvec2 occupied = uvec2(0u);
  uint lists = 0u, entries = 0u, words = 2u;
  for (uint i = 0u; i < VOXELS_PER_BRICK; ++i) {
    if (next[i] > 0u) occupied |= voxelBit(i);
    words += next[i] + (next[i] > 0u ? 1u : 0u);
  }
  uint capacity = uint(runs.length()), place = brickWork.usedWords + atomicAdd(brickWork.fewWords, words);
  uint header = 2u + uint(bitCount(occupied.x) + bitCount(occupied.y));
  atomicAdd(brickWork.fewHeaderWords, header);
  atomicMax(brickWork.fewLongest, words);
  if (words > capacity || place > capacity - words) return;
  run = place;
  runEntries = place + header;
  runEnd = place + words;
  runs[place] = occupied.x;
  runs[place + 1u] = occupied.y;
  for (uint i = 0u; i < VOXELS_PER_BRICK; ++i) {
    uint count = next[i];
    next[i] = runEntries + entries;
    entries += count;
    if (count > 0u) runs[place + 2u + lists++] = entries;
  }
}

void fillRun(ivec3 brick) {
  for (uint i = lane; i < touchCount; i += TRIANGLE_BLOCK) {
    uvec2 voxels = touched[i];
    while (voxels != uvec2(0u)) {
      uint voxel = takeVoxel(voxels);
      runs[atomicAdd(next[voxel], 1u)] = packVoxelEntry(touching[i], voxel);
    }
  }
  memoryBarrierBuffer();
  barrier();
  for (uint i = runEntries + lane; i < runEnd; i += TRIANGLE_BLOCK) makeBox(i, brick);
}

void endBuild(uint count) {
  bool room = brickWork.usedWords + brickWork.fewWords <= uint(runs.length());
  for (uint i = lane; i < count; i += TRIANGLE_BLOCK) bricks[requests[i].brick] = room ? requests[i].run : BRICK_MISSING;
  barrier();
  if (lane > 0u) return;
  if (room) {
    brickWork.usedWords += brickWork.fewWords;
    brickWork.headerWords += brickWork.fewHeaderWords;
    atomicMax(brickWork.longestRun, brickWork.fewLongest);
  } else {
    brickWork.waitingWords = brickWork.fewWords;
    brickWork.longestWaiting = brickWork.fewLongest;
  }
  brickWork.requestedBricks = brickWork.fewGroupsX = 0u;
  brickWork.fewDone = brickWork.fewWords = brickWork.fewHeaderWords = brickWork.fewLongest = 0u;
}

void main() {
  uint count = brickWork.requestedBricks, build = gl_WorkGroupID.x;
  if (count > MAX_FEW_BRICKS || build >= count || brickWork.waitingWords > 0u) return;
  uint number = requests[build].brick;
  ivec3 brick = brickAt(number);
  if (lane == 0u) {
    touchCount = 0u;
    run = BRICK_MISSING;
  }
  next[lane] = 0u;
  barrier();
  listTriangles(brick);
  barrier();
  bool heavy = touchCount > maxTriangles;
  if (!heavy) countEntries(brick, number);
  barrier();
  if (lane == 0u && !heavy) placeRun();
  if (lane == 0u && heavy) atomicAdd(brickWork.heavyBricks, 1u);
  barrier();
  if (run != BRICK_MISSING) fillRun(brick);
  memoryBarrierBuffer();
  barrier();
  if (lane == 0u) {
    requests[build].run = run;
    memoryBarrierBuffer();
    last = atomicAdd(brickWork.fewDone, 1u) + 1u == count;
  }
  barrier();
  memoryBarrierBuffer();
  if (last) endBuild(count);
}
