// Bindings of the methods' passes.
#ifndef HALFSILVER_PASSES_TRACING_H
#define HALFSILVER_PASSES_TRACING_H

#define SSBO_HIT_SURFACES 9  // HitSurface[], methods that store attributes
// The method's own structure.
#define SSBO_VOXELS 10
#define SSBO_HEADS 11
#define SSBO_ENTRIES 12
#define SSBO_LINKS 13
#define SSBO_COUNTERS 14
#define SSBO_PAUSED 15  // PausedRay[], while rays are traced
// What a build of bricks needs for a while.
#define SSBO_OUTER 13        // while rays are traced, in place of a build's candidates
#define SSBO_BRICK_BUILDS 5
#define SSBO_LIST_BUILD 9    // ListBuild; shares the number of surfaces that methods with attributes store
#define SSBO_MOVED_RUNS 8    // while runs are moved together, in place of hits
// Sums of normals while voxels are made, before there are heads, entries and links.
#define SSBO_NORMAL_X 11
#define SSBO_NORMAL_Y 12
#define SSBO_NORMAL_Z 13

#define IMAGE_POOL 7  // entries of the attribute method

#endif
