#pragma once

#include <filesystem>
#include <string>

#include <halfsilver/settings.h>

namespace halfsilver::demo {

// What the picture shows.
enum class View { picture, selection, answer, distance, normals, reflectivity, motion, cost, error };
inline constexpr const char* kViewNames[] = {"picture",      "selection", "what answered",    "hit distance", "normals",
                                             "reflectivity", "motion",    "cost of the walk", "error"};

enum class Cells { none, bricks, voxels };
inline constexpr const char* kCellNames[] = {"none", "bricks", "voxels by the length of their lists"};

// What the player has chosen.
struct Options {
  Settings settings, other;  // of the picture, and of the right side of a split screen
  bool overlay = true, keys = false, split = false, reference = false, frozen = false, verticalSync = true;
  Cells cells = Cells::none;  // of the structure, as boxes
  float splitAt = 0.5f;       // share of the width
  View view = View::picture;
  int samples = 1;         // per pixel, while nothing moves
  double frameTime = 0;    // milliseconds to hold; 0: full resolution
  double bestSeconds = 0;  // of the game; 0: none yet
};

// The player's folder of settings, by the XDG base directory specification; empty if the environment names none.
std::filesystem::path configFolder();

// What was kept there by the last run; a file that is missing or broken changes nothing.
void load(const std::filesystem::path& folder, Options& options);
// Returns false if it cannot be written, which is no error.
bool save(const std::filesystem::path& folder, const Options& options);

}  // namespace halfsilver::demo
