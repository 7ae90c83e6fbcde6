#pragma once

#include "bench/modes/mode.h"

namespace halfsilver::bench {

// Draws every scene with each method, still and during a slow motion: how wrong its hits are, how much it flickers
// beyond the reference, whether frames repeat to the bit, and what did not fit. Scenes without a motion of their own
// get a slow one of the camera. Without scenes: all failure scenes (builtin/failures.h). Its plan throws Error (failed)
// if the project is built without the reference.
Mode stabilityMode();

}  // namespace halfsilver::bench
