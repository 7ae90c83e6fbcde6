#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <halfsilver/budget.h>
#include <halfsilver/calibration.h>
#include <halfsilver/io.h>
#include <halfsilver/renderer.h>
#include <halfsilver/settings.h>

// What a run of `render` measured, as a statistics file and as a table.
namespace halfsilver {

double median(std::vector<double> values);  // 0 for none

// The stages of a frame in order; all of them are always present in the statistics.
std::vector<std::string> stageNames();

struct StageSummary {
  std::string stage;
  double median = 0, min = 0, max = 0;  // milliseconds, of the accepted runs
  std::size_t runs = 0;                 // accepted
  std::size_t rejected = 0;             // negative, or above ten times the median of three runs or more
};

// Collects the times of several frames.
class StageTimes {
 public:
  void add(std::span<const StageTime> frame);
  bool has(const std::string& stage) const;
  // All of stageNames(), then any others in order of appearance.
  std::vector<StageSummary> summarize() const;

 private:
  std::vector<std::pair<std::string, std::vector<double>>> samples_;
};

// How a run kept to its budget.
struct BudgetSummary {
  BudgetLimits limits;
  float minContribution = 0;  // of the last frame
  std::uint64_t dropped = 0;  // pixels of the last frame, because of the limits
  // Of effects that send several: of the last frame, and without limits.
  std::optional<std::pair<int, int>> raysPerPixel = {};
  bool settled = false;              // the threshold was at rest before the picture or the measured frames
  std::size_t frames = 0, held = 0;  // drawn since then, and how many of these were within the limits
};

struct RunStatistics {
  DeviceInfo device;
  std::string context;
  std::string sceneFile;
  std::size_t triangles = 0, vertices = 0, materials = 0, textures = 0, lights = 0;
  double diagonal = 0;  // meters
  Settings settings;
  int width = 0, height = 0;
  int samples = 1;     // per pixel; times are those of all
  FrameReport report;  // of the last frame
  std::optional<BudgetSummary> budget;
  std::optional<MethodChoice> choice;  // if trace.method was auto
  std::vector<StageSummary> stages;
  bool firstFrame = false;  // the times are of the first frame, which compiles shaders and allocates memory
  int warmUpFrames = 0;
  std::vector<std::pair<std::string, double>> wallMilliseconds;
  std::vector<std::string> warnings;
};

nlohmann::ordered_json toJson(const RunStatistics& statistics);

// What `compare --json` prints.
nlohmann::ordered_json toJson(const Comparison& comparison);

// The aligned table that `render` prints; ends with a newline.
std::string toTable(const RunStatistics& statistics);

// Text of a JSON value for a file or the screen; bytes that are not UTF-8 are replaced.
std::string dump(const nlohmann::ordered_json& json);

}  // namespace halfsilver
