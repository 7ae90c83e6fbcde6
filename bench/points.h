#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/statistics.h"
#include "bench/workbench.h"

namespace halfsilver::bench {

using PointList = std::vector<nlohmann::ordered_json>;

// What was measured, point by point, in one JSON file that is whole after each of them: an interrupted run goes on
// where it was.
class Points {
 public:
  // Reads what the file holds. Throws Error (badInput) where it is not a record of this mode.
  Points(std::filesystem::path file, std::string mode);

  // The point whose members include all of the key's with equal values; null where there is none.
  const nlohmann::ordered_json* find(const nlohmann::ordered_json& key) const;
  void keep(nlohmann::ordered_json point);

 private:
  std::filesystem::path file_;
  nlohmann::ordered_json record_;
};

// The members that identify a point: version, device, scene with its mirrors and camera, size, settings.
nlohmann::ordered_json pointKey(const RunStatistics& run, const BenchScene& scene);
// Adds what was measured: pixels, memory, overflow, lost fragments, warnings.
void addMeasured(nlohmann::ordered_json& point, const RunStatistics& run);

// Adds the times of the stages.
void addTimes(nlohmann::ordered_json& point, const RunStatistics& run);

// A folder that is made where it is missing, and removed again where nothing was put into it.
class OutputFolder {
 public:
  // Throws Error (failed) where it cannot be made or is a file.
  explicit OutputFolder(const std::filesystem::path& path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
  std::vector<std::filesystem::path> made_;  // innermost first
};

}  // namespace halfsilver::bench
