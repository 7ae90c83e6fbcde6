#pragma once

#include <vector>

#include "bench/modes/mode.h"

namespace halfsilver::bench {

// What a frame costs as more and more of the screen is traced, from the center outward and scattered: coverage.csv,
// coverage_fits.csv, coverage.json, .svg and .png.
Mode coverageMode();

// The numbers 0..last in bit-reversed order: neighbors are far apart in time, so that a machine that slowly warms up or
// gets other work does not look like a trend.
std::vector<int> scatteredOrder(int last);

}  // namespace halfsilver::bench
