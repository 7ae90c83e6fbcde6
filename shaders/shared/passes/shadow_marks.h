// Bindings of passes/shadow_test.comp and passes/spread_marks.comp, and of what reads the marks (lib/shadow_marks.glsl).
#ifndef HALFSILVER_PASSES_SHADOW_MARKS_H
#define HALFSILVER_PASSES_SHADOW_MARKS_H

#define UNIT_SHADOW_MARKS 23  // usampler2DArray, see GBuffer::shadowMarks
#define IMAGE_SHADOW_MARKS 3

#define LIGHTS_PER_MARK 32u  // lights of a layer

#endif
