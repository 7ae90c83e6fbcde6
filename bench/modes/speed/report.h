#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/modes/speed/point.h"
#include "bench/report/charts/chart.h"
#include "bench/report/page.h"
#include "bench/report/table.h"

// The points of the mode `speed` as tables, charts and the body of its page.
namespace halfsilver::bench {

using SpeedPoints = std::span<const SpeedPoint>;

enum class FrameKind { first, warm };

Table speedCsv(SpeedPoints points);      // plain numbers, one row per point
Table speedSummary(SpeedPoints points);  // for a terminal
StackedBars speedChart(SpeedPoints points, FrameKind kind);
std::string speedBody(SpeedPoints points, const std::vector<Figure>& pictures, const std::optional<std::string>& warm,
                      const std::optional<std::string>& first);

}  // namespace halfsilver::bench
