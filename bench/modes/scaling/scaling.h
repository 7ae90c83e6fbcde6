#pragma once

#include "bench/modes/mode.h"

namespace halfsilver::bench {

// Cost and memory against triangles (finer, and more objects), pixels, coverage, lights and bounces, one at a time, on
// scenes made for it: scaling.csv, scaling_exponents.csv, scaling_limits.csv, scaling.json, .svg and .png. A point that
// fails is kept with its message, and larger ones of its preset and axis are skipped.
Mode scalingMode();

}  // namespace halfsilver::bench
