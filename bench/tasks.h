#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "bench/points.h"

namespace halfsilver::bench {

// One point that a mode wants to have.
struct Task {
  nlohmann::ordered_json key;                            // see pointKey()
  std::string label;                                     // for the progress
  double work = 1;                                       // in any unit that grows with the time it takes
  std::function<void(nlohmann::ordered_json&)> measure;  // adds what was measured to the key's members
};

// The points of all tasks in their order: those that are kept, and the others, measured one after the other and kept
// each as soon as it is there.
std::vector<nlohmann::ordered_json> measureAll(Points& points, std::span<const Task> tasks);

}  // namespace halfsilver::bench
