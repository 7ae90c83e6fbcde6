#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/modes/memory/point.h"
#include "bench/report/charts/chart.h"
#include "bench/report/page.h"
#include "bench/report/table.h"

// The points of the mode `memory` as tables, a chart and the body of its page.
namespace halfsilver::bench {

using MemoryPoints = std::span<const MemoryPoint>;

Table memoryCsv(MemoryPoints points);      // plain numbers, one row per point
Table memorySummary(MemoryPoints points);  // for a terminal
StackedBars memoryChart(MemoryPoints points);
std::string memoryBody(MemoryPoints points, const std::vector<Figure>& pictures, const std::optional<std::string>& svg);

}  // namespace halfsilver::bench
