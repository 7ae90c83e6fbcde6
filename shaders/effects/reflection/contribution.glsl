// What a pixel's reflection contributes to the picture; reads the shaded G-buffer.
#include "effects/common/dither.glsl"
#include "lib/blend.glsl"
#include "lib/display.glsl"
#include "shared/structs.h"

// What the reflection of something as bright as white adds to the displayed color: 0..1, the largest of its components.
float wholeContribution(ivec2 pixel, vec4 normal) {
  Blend blend = blendOf(pixel, normal);
  vec3 added = displayed(blend.base + blend.share / frame.exposure) - displayed(blend.base);
  return max(max(added.r, added.g), added.b);
}

// Pixels whose contributions are within a quarter of an octave are thinned out evenly: a mirror that contributes the
// same everywhere must not vanish at once.
const float EQUAL_OCTAVES = 0.25;

float contributionOf(ivec2 pixel, vec4 normal) {
  return wholeContribution(pixel, normal) * exp2(-EQUAL_OCTAVES * scatteredThreshold(uvec2(pixel)));
}

uint contributionClass(float contribution) {
  float fromLeast = log2(max(contribution, exp2(-float(CONTRIBUTION_OCTAVES)))) + float(CONTRIBUTION_OCTAVES);
  return min(uint(fromLeast * float(CONTRIBUTION_CLASSES / CONTRIBUTION_OCTAVES)), uint(CONTRIBUTION_CLASSES) - 1u);
}
