#include "apps/demo/frame_log.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace halfsilver::demo {

std::string toLine(const FrameFigures& figures) {
  const FrameReport& report = figures.report;
  nlohmann::ordered_json line;
  line["frame"] = figures.frame;
  line["wall_ms"] = figures.wallMilliseconds;
  line["width"] = figures.width;
  line["height"] = figures.height;
  line["scale"] = figures.scale;
  line["traced_share"] = figures.tracedShare;
  line["coverage"] = report.pixels ? static_cast<double>(report.selected) / static_cast<double>(report.pixels) : 0.0;
  line["reflecting"] = report.reflecting;
  line["rays"] = report.selected;
  line["overflow"] = report.overflow;
  line["structure_bytes"] = report.memory.structureTotal;
  line["total_bytes"] = report.memory.peak;
  line["status"] = figures.status;
  line["time_ms"] = nlohmann::ordered_json::object();
  for (const StageTime& time : report.times)
    line["time_ms"][time.stage] = line["time_ms"].value(time.stage, 0.0) + std::max(0.0, time.milliseconds);
  return line.dump() + "\n";
}

void FrameLog::add(const FrameFigures& figures) {
  last_ = figures;
  for (auto& [stage, series] : stages_) series.milliseconds[next_] = 0;
  for (const StageTime& time : figures.report.times)
    stages_[time.stage].milliseconds[next_] += static_cast<float>(std::max(0.0, time.milliseconds));
  for (auto& [stage, series] : stages_)
    series.max = *std::max_element(series.milliseconds.begin(), series.milliseconds.end());
  next_ = (next_ + 1) % kFrames;
}

}  // namespace halfsilver::demo
