#pragma once

#include <vector>

#include "bench/mode.h"

namespace halfsilver::bench {

// What a frame costs as more and more of the screen is traced, from the centre outwards and scattered: coverage.csv,
// coverage_fits.csv, coverage.json, .svg and .png.
Mode coverageMode();

// The numbers 0..last in the order of their bits read backwards: neighbours are far apart in time, so that a machine
// that slowly warms up or gets other work does not look like a trend.
std::vector<int> scatteredOrder(int last);

}  // namespace halfsilver::bench
