// Bindings of the G-buffer pass: passes/visibility.* and passes/gbuffer.comp.
#ifndef HALFSILVER_PASSES_GBUFFER_H
#define HALFSILVER_PASSES_GBUFFER_H

#define SSBO_DRAW_LIST 9  // uint[triangles]: triangle numbers in drawing order

#define SSBO_SIGNATURE 10  // uint

#define SSBO_PRIMARY_COUNTS 11  // uint[2], see GBuffer::primaryCounts

#define INTERPOLATED -2.0  // of GBuffer::material

#define IMAGE_NORMAL 2
#define IMAGE_MATERIAL 3
#define IMAGE_TESTED 4
#define IMAGE_LOBES 5
#define IMAGE_COAT 6

#endif
