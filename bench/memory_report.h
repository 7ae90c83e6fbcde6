#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/chart.h"
#include "bench/table.h"

// The points of the mode `memory` as tables, a chart and a page.
namespace halfsilver::bench {

struct ScenePicture {
  std::string name;
  std::string png;  // bytes
};

using MemoryPoints = std::vector<nlohmann::ordered_json>;

Table memoryCsv(const MemoryPoints& points);      // plain numbers, one row a point
Table memorySummary(const MemoryPoints& points);  // for a terminal
StackedBars memoryChart(const MemoryPoints& points);
std::string memoryPage(const MemoryPoints& points, const std::vector<ScenePicture>& scenes,
                       const std::optional<std::string>& svg);

}  // namespace halfsilver::bench
