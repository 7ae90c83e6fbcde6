// Bindings of the motion vectors: passes/motion.comp, and lib/motion.glsl for whoever else follows a point back.
#ifndef HALFSILVER_PASSES_MOTION_H
#define HALFSILVER_PASSES_MOTION_H

#define UBO_PREVIOUS_FRAME 1         // FrameConstants of the frame before
#define SSBO_PREVIOUS_POSITIONS 10   // float[3 * vertices] of the frame before

#define IMAGE_MOTION 0

#endif
