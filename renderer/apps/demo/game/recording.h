#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "apps/demo/game/input.h"

// The inputs of a round as a text file: a line each for what it is and its version, the steps per second, the seed and
// then one line for each run of equal inputs:
//
//   halfsilver-recording 1
//   steps-per-second 60
//   seed 0
//   COUNT MOVE_X MOVE_Y LOOK_X LOOK_Y BUTTONS
//
// Numbers are whole (see Input). Empty lines and those that begin with # are skipped.
namespace halfsilver::demo {

struct Recording {
  std::uint32_t seed = 0;
  std::vector<Input> inputs;

  bool operator==(const Recording&) const = default;
};

std::string toText(const Recording& recording);
// Throws Error (badInput) with `name` and the line that is wrong.
Recording parseRecording(std::string_view text, const std::string& name);

// Throw Error: failed if the file cannot be written, badInput if it cannot be read.
void writeRecording(const std::filesystem::path& file, const Recording& recording);
Recording readRecording(const std::filesystem::path& file);

}  // namespace halfsilver::demo
