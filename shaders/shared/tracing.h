// Constants of the voxel grid and the paged A-buffers, shared by C++ and GLSL.
#ifndef HALFSILVER_TRACING_H
#define HALFSILVER_TRACING_H

#include "shared/passes/tracing.h"

// Voxels are packed eight to a word: four bits each, of which bits 0..2 say in which A-buffers (x, y, z) the voxel's
// fragments are. Bit 3 is set where moved triangles came to at the last move (identity only).
#define VOXELS_PER_WORD 8
#define VOXEL_BITS 4
#define VOXEL_MOVED 8u

// A head word is 0 for an empty texel, else (page + 1) << PAGE_FILL_BITS | entries in that page. HEAD_INCOMPLETE is set
// where the pool had no room for a fragment: a ray that comes by is an overflow, not a miss.
// Linked lists are pages of one entry: their shaders define one bit for the fill and so can number more pages.
#ifndef PAGE_FILL_BITS
#define PAGE_FILL_BITS 7
#endif
#define PAGE_FILL_MASK ((1u << PAGE_FILL_BITS) - 1u)
#define HEAD_INCOMPLETE 0x80000000u
#define MOST_PAGES 0xfffffeu
#define MOST_LINKED_ENTRIES 0x3ffffffeu

// Counters of a build, spread over COUNTER_SLOTS copies to spare the atomics; only slot 0 counts pages.
#define COUNTER_SLOTS 64
#define COUNTER_KINDS 8
#define COUNTER_PAGES 0      // pages asked for
#define COUNTER_SPARE 1      // a page + 1 that was taken but not linked, free for the next taker
#define COUNTER_FRAGMENTS 2  // made by rasterization
#define COUNTER_LOST 3       // stored nowhere: the pool was full
#define COUNTER_STORED_X 4   // stored in the A-buffer of x; y and z follow
#define COUNTER_UNSORTED 7   // set by a sorting step that still found two runs to merge

// Fixed-point scale of the sums of normals in a voxel.
#define NORMAL_SCALE 4096.0

// Voxels along a side of a brick. A brick's state is the place of its run of lists, or one of these.
#define BRICK_SIDE 4
#define BRICK_EMPTY 0xffffffffu    // no triangle touches it
#define BRICK_MISSING 0xfffffffeu  // never asked for
#define BRICK_CLAIMED 0xfffffffdu  // a ray is about to ask for it
#define BRICK_REQUESTED 0x80000000u  // + its number among those that rays wait for

// Prefix sums: invocations a group.
#define SUM_GROUP 128

// Hit::triangle of a ray that a dispatch left unfinished; Hit::t is where to go on.
#define UNFINISHED_TRIANGLE 0xfffffffeu

#endif
