#pragma once

#include "bench/mode.h"

namespace halfsilver::bench {

// Draws every scene still and over a slow move with each method: how wrong its hits are, how it flickers beyond the
// reference, whether frames repeat to the bit, and what found no room. Scenes without a move of their own get a slow
// one of the camera. Without scenes: all failure scenes (scene/failures.h). Its plan throws Error (failed) where the
// project is built without the reference.
Mode stabilityMode();

}  // namespace halfsilver::bench
