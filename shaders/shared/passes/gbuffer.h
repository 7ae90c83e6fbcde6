// Bindings of the G-buffer pass: passes/visibility.* and passes/gbuffer.comp.
#ifndef HALFSILVER_PASSES_GBUFFER_H
#define HALFSILVER_PASSES_GBUFFER_H

#define SSBO_DRAW_LIST 9  // uint[triangles]: triangle numbers in drawing order

#define SSBO_SIGNATURE 10  // uint

#define SSBO_PRIMARY_COUNTS 11  // uint[2], see GBuffer::primaryCounts

#define IMAGE_POSITION 2
#define IMAGE_NORMAL 3
#define IMAGE_MATERIAL 4
#define IMAGE_TESTED 5
#define IMAGE_LOBES 6
#define IMAGE_COAT 7

#endif
