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
  double work = 1;                                       // see workOf()
  std::function<void(nlohmann::ordered_json&)> measure;  // adds what was measured to the key's members
  // Tasks of one series get harder; those that follow a point for which `ends` holds are left out.
  std::string series = {};
  std::function<bool(const nlohmann::ordered_json&)> ends = {};
};

// About as much time as it takes, in a unit that all modes share: it grows with the triangles, above what every frame
// takes.
double workOf(double frames, std::size_t triangles);

struct Batch {
  std::string mode;  // for the progress
  Points points;
  std::vector<Task> tasks;
};

// The points of all tasks in their order, batch by batch: those that are kept, and the others, measured one after the
// other and kept each as soon as it is there.
std::vector<PointList> measureAll(std::span<Batch> batches);

}  // namespace halfsilver::bench
