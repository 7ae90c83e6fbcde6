// Bindings and constants of temporal antialiasing: passes/reflection_motion.comp, passes/temporal.comp.
#ifndef HALFSILVER_PASSES_TEMPORAL_H
#define HALFSILVER_PASSES_TEMPORAL_H

// Beside those of the lit layers; these passes read no material textures.
#define UNIT_MOTION 2
#define UNIT_REFLECTION_MOTION 3  // see IMAGE_REFLECTION_MOTION
#define UNIT_PAST_FRAMES 4        // see IMAGE_FRAME
#define UNIT_COUNTS_BEFORE 5      // see IMAGE_COUNTS
#define UNIT_DEPTHS_BEFORE 6      // see IMAGE_DEPTHS

#define IMAGE_REFLECTION_MOTION 0  // xy pixels since the frame before, z depth of the image now, w in the frame before
#define IMAGE_MEAN 0               // mean radiance, a the number of frames in it
#define IMAGE_FRAME 1              // LAYER_... of TEMPORAL_FRAMES frames in turn, see packSample()
#define IMAGE_COUNTS 2             // frames that show the same as this one, of the surface and of the image in it
#define IMAGE_DEPTHS 3             // meters along the view axis: of the surface, of the image in it (0: none)

#define LAYER_SURFACE 0
#define LAYER_REFLECTED 1

#define TEMPORAL_GROUP 16   // pixels along a side of a group of passes/temporal.comp
#define TEMPORAL_FRAMES 16  // that a moving picture is the mean of; a whole part of the sequence of samples

// What a frame adds to: nothing, the mean of frames of the same moment, or what it can follow back.
#define HISTORY_NONE 0
#define HISTORY_STILL 1
#define HISTORY_MOVING 2

#define VERY_FAR 1.0e30  // depth of the sky

#endif
