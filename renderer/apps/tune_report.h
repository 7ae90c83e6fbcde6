#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <halfsilver/renderer.h>
#include "apps/pareto.h"
#include "apps/tune_candidates.h"

// What `tune` found, as a table and as a configuration file.
namespace halfsilver {

struct TunePoint {
  Candidate candidate;
  Cost cost;             // medians
  std::size_t runs = 0;  // measured frames
};

struct TuneReport {
  std::string view;  // scene, camera and mirrors as on the command line
  DeviceInfo device;
  std::string context;
  int width = 0, height = 0;
  std::size_t triangles = 0;
  double coverage = 0;  // 0..1, fraction of the pixels that is traced
  double maxError = 0;  // 0..1, as requested
  std::vector<TunePoint> points;
  std::vector<std::string> skipped;  // candidates that could not be measured, with the reason
  std::size_t choice = 0;            // index of the chosen point
};

// Ends with a newline.
std::string tuneTable(const TuneReport& report);

// TOML for `render --config`: the chosen settings, with the measured front as comments.
std::string tuneConfig(const TuneReport& report);

}  // namespace halfsilver
