#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/harness/fields.h"
#include "bench/harness/points.h"

namespace halfsilver::bench {

// One point that a mode wants to have. `P` is a Point.
template <class P>
struct Task {
  typename P::Key key;
  std::string label;  // for the progress line
  double work = 1;    // see workOf()
  std::function<typename P::Result()> measure;
  // Tasks of one series get harder: those that follow a point for which `ends` holds are skipped.
  std::string series = {};
  std::function<bool(const P&)> ends = {};
};

// A task of any mode. Its points are JSON, as in the file.
struct AnyTask {
  nlohmann::ordered_json key;
  std::string label;
  double work = 1;
  std::function<nlohmann::ordered_json()> measure;  // members to add to the key's
  std::string series;
  std::function<bool(const nlohmann::ordered_json&)> ends;
};

template <class P>
AnyTask anyTask(Task<P> task) {
  AnyTask any{task.key, std::move(task.label), task.work, {}, std::move(task.series), {}};
  any.measure = [measure = std::move(task.measure)] { return nlohmann::ordered_json(measure()); };
  if (task.ends)
    any.ends = [ends = std::move(task.ends)](const nlohmann::ordered_json& point) { return ends(fromJson<P>(point)); };
  return any;
}

// Roughly proportional to the time that it takes, in a unit that all modes share: grows with the triangles, above what
// every frame takes.
double workOf(double frames, std::size_t triangles);

struct Batch {
  std::string mode;  // for the progress line
  Points points;
  std::vector<AnyTask> tasks;
};

using MeasuredPoints = std::vector<nlohmann::ordered_json>;

// The points of all tasks in their order, batch by batch: those that are in the files already, and the others, each
// measured and kept at once.
std::vector<MeasuredPoints> measureAll(std::span<Batch> batches);

}  // namespace halfsilver::bench
