#pragma once

#include "bench/modes/mode.h"

namespace halfsilver::bench {

// Draws every scene with each effect, over the default and over exact rays, with few and many rays per pixel: the time
// of a frame against its error, and what a ray costs.
Mode effectsMode();

}  // namespace halfsilver::bench
