// Bindings and constants of the layered depth cube: tracing/depth_cube/.
#ifndef HALFSILVER_PASSES_DEPTH_CUBE_H
#define HALFSILVER_PASSES_DEPTH_CUBE_H

#define SSBO_CUBE_BLOCKS 12  // vec2[3 * blocks^2]: least and greatest depth; the first is greater in empty ones
#define SSBO_CUBE_COUNTS 13  // uint[3 * texels^2]: samples that a texel has, stored or not

// The stored layers, arrays of three images side by side, x to z.
#define UNIT_CUBE_DEPTHS 19     // sampler2DArray: 0..1 in the grid's space; CUBE_NO_SAMPLE behind a texel's last
#define UNIT_CUBE_NORMALS 20    // usampler2DArray: see packUnit()
#define UNIT_CUBE_TRIANGLES 21  // usampler2DArray
#define UNIT_CUBE_COLORS 22     // sampler2DArray: roots of base color and reflectivity
// While it is built.
#define UNIT_CUBE_PREVIOUS 19  // sampler2D: depths of the layer before
#define IMAGE_CUBE_NORMALS 0
#define IMAGE_CUBE_COLORS 1

#define CUBE_NO_SAMPLE 2.0f

// Of the counters of a build (shared/tracing.h), one that it does not use otherwise.
#define COUNTER_DEEPEST COUNTER_PAGES  // most samples that a texel has

#endif
