#pragma once

#include "bench/modes/mode.h"

namespace halfsilver::bench {

// Draws every scene during a slow pan, without antialiasing and with frames joined over time: how much each picture
// flickers and how far it is from the mean of many samples in the same frames.
Mode antialiasingMode();

}  // namespace halfsilver::bench
