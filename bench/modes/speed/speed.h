#pragma once

#include "bench/modes/mode.h"

namespace halfsilver::bench {

// What each method takes, stage by stage, and what its rays do: speed.csv, .json, .svg and .png.
Mode speedMode();

}  // namespace halfsilver::bench
