#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/modes/demo/point.h"
#include "bench/report/charts/chart.h"
#include "bench/report/page.h"
#include "bench/report/table.h"

// The points of the mode `demo` as tables, charts and the body of its page.
namespace halfsilver::bench {

using DemoPoints = std::span<const DemoPoint>;

// Of the frames after the first ones, which compile shaders and reserve memory.
struct DemoSummary {
  double median = 0, percentile99 = 0;  // milliseconds
  double steady = 0;                    // share of the frames within twice the median
  double meanCoverage = 0, lowestScale = 1, lowestShare = 1;
  std::uint64_t mostStructure = 0, mostTotal = 0, overflow = 0;
  std::int64_t growth = 0;  // of all bytes, from there to the largest frame
};
DemoSummary summarize(const DemoPoint& point);

Table demoCsv(DemoPoints points);    // plain numbers, one row per frame
Table demoTable(DemoPoints points);  // for people, one row per method
PanelGrid demoChart(DemoPoints points);
std::string demoBody(DemoPoints points, const std::vector<Figure>& pictures, const std::optional<std::string>& svg);

}  // namespace halfsilver::bench
