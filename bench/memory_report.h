#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/chart.h"
#include "bench/report.h"
#include "bench/table.h"

// The points of the mode `memory` as tables, a chart and the text of its page.
namespace halfsilver::bench {

Table memoryCsv(const PointList& points);      // plain numbers, one row a point
Table memorySummary(const PointList& points);  // for a terminal
StackedBars memoryChart(const PointList& points);
std::string memoryBody(const PointList& points, const std::vector<ScenePicture>& scenes,
                       const std::optional<std::string>& svg);

}  // namespace halfsilver::bench
