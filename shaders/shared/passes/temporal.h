// Bindings and constants of temporal antialiasing: passes/reflection_motion.comp, passes/temporal.comp.
#ifndef HALFSILVER_PASSES_TEMPORAL_H
#define HALFSILVER_PASSES_TEMPORAL_H

// Beside those of the lit layers; these passes read no material textures.
#define UNIT_MOTION 2
#define UNIT_REFLECTION_MOTION 3  // see IMAGE_REFLECTION_MOTION
#define UNIT_SURFACE_HISTORY 4    // mean radiance of the surface, and of how many frames
#define UNIT_REFLECTED_HISTORY 5  // the same of what it reflects
#define UNIT_DEPTH_HISTORY 6      // meters along the view axis: of the surface, of the image in it (0: none)

#define IMAGE_REFLECTION_MOTION 0  // xy pixels since the frame before, z depth of the image now, w in the frame before
#define IMAGE_SURFACE 0
#define IMAGE_REFLECTED 1
#define IMAGE_DEPTHS 2

#define TEMPORAL_GROUP 16  // pixels along a side of a group of passes/temporal.comp

// What a frame adds to: nothing, the mean of frames of the same moment, or what it can follow back.
#define HISTORY_NONE 0
#define HISTORY_STILL 1
#define HISTORY_MOVING 2

#define VERY_FAR 1.0e30  // depth of the sky

#endif
