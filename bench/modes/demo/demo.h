#pragma once

#include "bench/modes/mode.h"

namespace halfsilver::bench {

// The game, played by a recording: frame times, memory and coverage, frame by frame: demo.csv, demo.json, .svg and
// .png.
Mode demoMode();

}  // namespace halfsilver::bench
