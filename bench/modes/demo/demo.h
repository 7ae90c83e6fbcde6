#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "bench/modes/demo/point.h"
#include "bench/modes/mode.h"

namespace halfsilver::bench {

// The game, played by a recording: frame times, memory and coverage, frame by frame: demo.csv, demo.json, .svg and
// .png.
Mode demoMode();

// What `demo --stats` has written: a frame per line. Throws Error (badInput), naming the file and the line, if one is
// something else.
std::vector<DemoFrame> readFrames(std::istream& lines, const std::string& file);

}  // namespace halfsilver::bench
