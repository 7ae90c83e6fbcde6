// Structure of the identity method: bricks of BRICK_SIDE^3 voxels, each with its lists in one run of words, made when a
// ray first asks for it. A run: which voxels have lists (two words, a bit each), where their entries end, counted from
// the first entry (a word per list), and the entries (see entry.glsl). A list holds the fragments of all three
// A-buffers, whose texels and depths are the voxels', side by side. Programs that write runs define RUN_ACCESS, and
// those that only read states BRICK_ACCESS, before anything else.
#include "shared/passes/identity.h"
#include "tracing/common/grid.glsl"

#ifndef RUN_ACCESS
#define RUN_ACCESS readonly
#endif
#ifndef BRICK_ACCESS
#define BRICK_ACCESS coherent
#endif
layout(std430, binding = SSBO_BRICKS) BRICK_ACCESS buffer BrickBlock { uint bricks[]; };
layout(std430, binding = SSBO_RUNS) RUN_ACCESS buffer RunBlock { uint runs[]; };

ivec3 brickOf(ivec3 voxel) { return voxel >> BRICK_SHIFT; }

uint brickIndex(ivec3 brick) {
  ivec3 count = voxelCount >> BRICK_SHIFT;
  return uint(brick.x + count.x * (brick.y + count.y * brick.z));
}

ivec3 brickAt(uint index) {
  ivec3 count = voxelCount >> BRICK_SHIFT;
  int i = int(index);
  return ivec3(i % count.x, i / count.x % count.y, i / (count.x * count.y));
}

// A voxel's number in its brick, and where that voxel is.
uint voxelInBrick(ivec3 voxel) {
  ivec3 v = voxel & (BRICK_SIDE - 1);
  return uint(v.x | v.y << BRICK_SHIFT | v.z << (2 * BRICK_SHIFT));
}

// An empty brick begins empty cubes of bricks, one in each of the eight directions. Their sides are powers of two.
bool emptyBrick(uint state) { return state >= BRICK_EMPTY; }
int emptySide(uint state, uint octant) { return 1 << ((state >> (EMPTY_SIDE_BITS * octant)) & 7u); }

ivec3 voxelOfBrick(uint number) {
  return ivec3(number, number >> BRICK_SHIFT, number >> (2 * BRICK_SHIFT)) & (BRICK_SIDE - 1);
}

bool present(uint state) { return state < BRICK_REQUESTED; }
// Rays wait for it; its number among such is what is left of the state.
bool requested(uint state) { return state >= BRICK_REQUESTED && state < BRICK_CLAIMED; }

// Words before a run's entries, and all its words.
uint headerWords(uint run) { return 2u + uint(bitCount(runs[run]) + bitCount(runs[run + 1u])); }
uint runWords(uint run) {
  uint header = headerWords(run);
  return header + (header > 2u ? runs[run + header - 1u] : 0u);
}

// Entries of a voxel: from x to before y. `side`: of the cube around it, aligned to its size, that has no others.
uvec2 listOf(uint run, ivec3 voxel, out int side) {
  uint number = voxelInBrick(voxel), bit = 1u << (number & 31u);
  uvec2 occupied = uvec2(runs[run], runs[run + 1u]);
  uint word = number < 32u ? occupied.x : occupied.y;
  // Eight voxels: two along each axis.
  uint eight = 0x330033u << (uint(voxel.x & 2) | uint(voxel.y & 2) << BRICK_SHIFT);
  side = (word & eight) == 0u ? 2 : 1;
  if ((word & bit) == 0u) return uvec2(0u);
  uint low = uint(bitCount(occupied.x));
  uint rank = uint(bitCount(word & (bit - 1u))) + (number < 32u ? 0u : low);
  uint ends = run + 2u, entries = ends + low + uint(bitCount(occupied.y));
  return entries + uvec2(rank > 0u ? runs[ends + rank - 1u] : 0u, runs[ends + rank]);
}
