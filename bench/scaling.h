#pragma once

#include "bench/mode.h"

namespace halfsilver::bench {

// Cost and memory against triangles (finer, and more objects), pixels, coverage, lights and bounces, one at a time, on
// scenes that are made for it: scaling.csv, scaling_exponents.csv, scaling_limits.csv, scaling.json, .svg and .png. A
// point that fails is kept with its message, and no larger one of its preset and axis is tried.
Mode scalingMode();

}  // namespace halfsilver::bench
