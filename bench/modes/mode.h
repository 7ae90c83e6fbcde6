#pragma once

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/harness/output_folder.h"
#include "bench/harness/request.h"
#include "bench/harness/tasks.h"
#include "bench/harness/workbench.h"
#include "bench/modes/common_text.h"
#include "bench/report/report.h"

// A mode is a function that plans: it says what points it wants to have, and what it will report about them. Measuring,
// keeping and writing are the same for all (runModes).
namespace halfsilver::bench {

// What a mode works with. All of it lives until the report is written.
struct Setup {
  const Request& request;
  std::vector<BenchScene>& scenes;  // those of the request
  Workbench& bench;
  const OutputFolder& folder;
};

struct Plan {
  std::vector<AnyTask> tasks;                           // at least one
  std::function<Report(const MeasuredPoints&)> report;  // of the points of the tasks that were measured
  std::string measuredWith;                             // see measuredWith()
};

// A plan for points of one type.
template <class P>
Plan makePlan(std::vector<Task<P>> tasks, std::function<Report(const std::vector<P>&)> report) {
  Plan plan;
  plan.measuredWith = measuredWith(tasks.front().key.version, tasks.front().key.device, tasks.front().key.size);
  for (Task<P>& task : tasks) plan.tasks.push_back(anyTask(std::move(task)));
  plan.report = [report = std::move(report)](const MeasuredPoints& measured) {
    std::vector<P> points;
    for (const auto& json : measured) points.push_back(fromJson<P>(json));
    return report(points);
  };
  return plan;
}

struct Mode {
  std::string name;              // also of its files
  std::string description;       // one line
  bool takesPresets = false;     // --preset, see Request::presets
  bool takesMethods = false;     // --method, see Request::methods
  bool takesTimeLimit = false;   // --time-limit, see Request::timeLimit
  bool takesReplay = false;      // a recording of the game instead of scenes; such a mode is no part of `all`
  bool takesPaper = false;       // a paper's name instead of scenes; likewise
  bool bringsOwnScenes = false;  // if the command names none; always in `all`
  // Throws Error: a bad request must not show after an hour's work. Error (failed) excludes the mode from `all`.
  std::function<Plan(const Setup&)> plan;
};

// Measures and writes one folder with the files of all modes and one page.
void runModes(const Request& request, std::span<const Mode> modes);

// Adds a command for each mode, and `all` of those that take scenes.
void addModes(CLI::App& program, const std::vector<Mode>& modes);

}  // namespace halfsilver::bench
