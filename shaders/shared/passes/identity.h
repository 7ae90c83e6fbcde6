// Bindings, constants and structs of the identity method: tracing/identity/.
#ifndef HALFSILVER_PASSES_IDENTITY_H
#define HALFSILVER_PASSES_IDENTITY_H

#define SSBO_BRICKS 12      // uint[bricks]: where a brick's run is, or a state, below
#define SSBO_RUNS 13        // uint[]: words of runs, see tracing/identity/bricks.glsl
#define SSBO_BRICK_WORK 14  // BrickWork
#define SSBO_OUTER 15       // uint[1 + count]: triangles that reach beyond the grid: their count, then their numbers
// Builds touch no queue of rays and use its numbers; 5 and 7 are those of the counters and of listed triangles.
#define SSBO_BRICK_BUILDS 6     // BrickBuild[requested bricks]
#define SSBO_TRIANGLE_BLOCKS 8  // BoundedBlock[blocks of triangles]
#define SSBO_REQUESTS 9         // BrickRequest[requested bricks]; this method stores no surfaces of hits
#define SSBO_COMPACTED_RUNS 9   // uint[]: where compaction moves runs to
#define SSBO_MOVED_VERTICES 10  // MovedVertices
#define UBO_BUILD_STEP 1        // BuildStepBlock, see tracing/common/projections.glsl

// Voxels along a side of a brick. A brick's state is the place of its run, or one of these.
#define BRICK_SHIFT 2
#define BRICK_SIDE (1 << BRICK_SHIFT)
#define VOXELS_PER_BRICK (BRICK_SIDE * BRICK_SIDE * BRICK_SIDE)
#define BRICK_EMPTY 0xc0000000u      // no triangle touches it; + the sides of empty cubes that it begins
#define BRICK_MISSING 0xbfffffffu    // never asked for
#define BRICK_CLAIMED 0xbffffffeu    // a ray is about to ask for it
#define BRICK_REQUESTED 0x80000000u  // + its number among those that rays wait for

// Sides of empty cubes in bricks, as powers of two: bits for each of the eight directions, and the largest power.
#define EMPTY_SIDE_BITS 3u
#define MAX_EMPTY_SIDE 4
#define MAX_EMPTY_SIDES 0x924924u  // that, in all directions
// Bricks along the sides of a group that bounds them.
#define BOUND_GROUP_X 8
#define BOUND_GROUP_YZ 2

// A brick's voxel in the packed grid (see shared/tracing.h): triangles of the last move came to it.
#define VOXEL_MOVED 8u

// Triangles of a block that a build looks at, and of one that is said to have moved (see SceneExtents).
#define TRIANGLE_BLOCK 64
#define MOVED_BLOCK 256

// What rays ask for, and what becomes of it.
struct BrickWork {
  // Of the build under way: groups of its indirect dispatches over blocks of triangles, the triangles of those that are
  // wanted, builds, and builds with a group for each.
  uint blockGroupsX;
  uint blockGroupsY;
  uint blockGroupsZ;
  uint triangleGroupsX;
  uint triangleGroupsY;
  uint triangleGroupsZ;
  uint buildGroupsX;
  uint buildGroupsY;
  uint buildGroupsZ;
  uint groupsPerBuildX;
  uint groupsPerBuildY;
  uint groupsPerBuildZ;
  uint pairGroupsX;  // likewise, if large triangles are not rasterized
  uint pairGroupsY;
  uint pairGroupsZ;
  // Of a build in one step: its dispatch, a group for each requested brick, and what its groups have added up so far.
  uint fewGroupsX;
  uint fewGroupsY;
  uint fewGroupsZ;
  uint fewDone;         // groups
  uint fewWords;        // of their runs
  uint fewHeaderWords;  // of these, before the entries
  uint fewLongest;      // words of a run
  uint heavyBricks;     // that had too many triangles for a group
  uint wantedBlocks;
  uint buildCount;
  uint firstWord;         // behind the runs of earlier builds
  uint buildWords;        // of their runs, at most MAX_WAITING_WORDS each
  uint nextWord;          // behind the runs that have been placed, and beyond if one found no room
  uint requestedBricks;   // since the last build
  uint waitingWords;      // of runs that found no room, at most MAX_WAITING_WORDS each
  uint longestWaiting;    // of these, words
  uint usedWords;         // of all runs
  uint headerWords;       // of these, before the entries
  uint longestRun;        // words
  uint staleWords;        // of runs that were given up
  uint staleHeaderWords;  // of these, before the entries
  // The box of bricks that stopped being empty since empty cubes were bounded, as maxima, so that zeros are none:
  // FILLED_BELOW - the lowest brick, and 1 + the highest, along each axis.
  uint filledBelowX;
  uint filledBelowY;
  uint filledBelowZ;
  uint filledAboveX;
  uint filledAboveY;
  uint filledAboveZ;
  // Where cubes are bounded: groups of the indirect dispatches, one for each size of cubes, and the box of the bricks
  // that they may not hold.
  uint boundGroups[3 * MAX_EMPTY_SIDE];
  uint boundLowX;
  uint boundLowY;
  uint boundLowZ;
  uint boundHighX;
  uint boundHighY;
  uint boundHighZ;
};
#define FILLED_BELOW 1024
// A build of at most so many bricks goes over pairs of large triangles and bricks, in compute.
#define MAX_PAIRED_BRICKS 4096u
// A build of at most so many bricks may be done in one step.
#define MAX_FEW_BRICKS 4096u
// Keeps a sum of words in a word.
#define MAX_WAITING_WORDS 0x1ffffu

#endif
