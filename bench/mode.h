#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/points.h"
#include "bench/report.h"
#include "bench/request.h"
#include "bench/tasks.h"
#include "bench/workbench.h"

// A mode is a function that plans: it says what points it wants to have, and what it will report of them. Measuring,
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
  std::vector<Task> tasks;                         // at least one
  std::function<Report(const PointList&)> report;  // of the points of the tasks that were measured
};

struct Mode {
  std::string name;              // names the files, too
  std::string description;       // one line
  bool takesPresets = false;     // --preset, see Request::presets
  bool takesMethods = false;     // --method, see Request::methods
  bool takesTimeLimit = false;   // --time-limit, see Request::timeLimit
  bool bringsOwnScenes = false;  // where the command names none; always in `all`
  // Throws Error: a bad request must not show after an hour's work. Error (failed) leaves the mode out of `all`.
  std::function<Plan(const Setup&)> plan;
};

// Measures and writes one folder with the files of all modes and one page.
void runModes(const Request& request, std::span<const Mode> modes);

// Adds a command for each mode, and `all`.
void addModes(CLI::App& program, const std::vector<Mode>& modes);

}  // namespace halfsilver::bench
