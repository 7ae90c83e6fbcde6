// Of each pixel, what the shadow maps say of the lights around it (GBuffer::shadowMarks): x the lights that some
// surface of the neighborhood sees, y those that are hidden from one. A light in both is in doubt.
#include "shared/passes/shadow_marks.h"

layout(binding = UNIT_SHADOW_MARKS) uniform usampler2DArray shadowMarks;

uvec2 marksOf(ivec2 pixel, uint light) {
  return texelFetch(shadowMarks, ivec3(pixel, int(light / LIGHTS_PER_MARK)), 0).xy;
}

bool isMarked(ivec2 pixel, uint light) {
  uvec2 marks = marksOf(pixel, light);
  return (marks.x & marks.y & (1u << (light % LIGHTS_PER_MARK))) != 0u;
}

// Of a light that is not marked.
bool isLit(ivec2 pixel, uint light) { return (marksOf(pixel, light).x & (1u << (light % LIGHTS_PER_MARK))) != 0u; }
