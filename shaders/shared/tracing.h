// Constants that methods share, for C++ and GLSL.
#ifndef HALFSILVER_TRACING_H
#define HALFSILVER_TRACING_H

// Voxels are packed eight to a word: four bits each, of which bits 0..2 say in which A-buffers (x, y, z) the voxel's
// fragments are. Bit 3 is a method's own.
#define VOXELS_PER_WORD 8
#define VOXEL_BITS 4

// Counters of a build, spread over COUNTER_SLOTS copies so that atomics collide less; only slot 0 counts pages.
#define COUNTER_SLOTS 64
#define COUNTER_KINDS 8
#define COUNTER_PAGES 0      // pages asked for
#define COUNTER_SPARE 1      // a page + 1 that was taken but not linked, free for the next taker
#define COUNTER_FRAGMENTS 2  // made by rasterization
#define COUNTER_LOST 3       // stored nowhere: the pool was full
#define COUNTER_STORED_X 4   // stored in the A-buffer of x; y and z follow
#define COUNTER_UNSORTED 7   // set by a sorting step that still found two parts to merge

// Fixed-point scale of the sums of normals in a voxel.
#define NORMAL_SCALE 4096.0

#endif
