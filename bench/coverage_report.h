#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/chart.h"
#include "bench/report.h"
#include "bench/table.h"

// The points of the mode `coverage` as tables, charts and the text of its page.
namespace halfsilver::bench {

// The points of one scene, preset and pattern, by the share of the screen that was asked for.
struct CoverageCurve {
  std::string scene, preset, pattern;
  PointList points;
};
using CoverageCurves = std::vector<CoverageCurve>;

// In the order in which they occur first. Rounds become one point: its times are their median, least and most.
CoverageCurves coverageCurves(const PointList& points);

Table coverageCsv(const CoverageCurves& curves);      // plain numbers, one row a point
Table fitsCsv(const CoverageCurves& curves);          // one row a curve and quantity
Table coverageSummary(const CoverageCurves& curves);  // for a terminal
PanelGrid coverageChart(const CoverageCurves& curves);
std::string coverageBody(const CoverageCurves& curves, const std::vector<ScenePicture>& scenes,
                         const std::optional<std::string>& svg);

}  // namespace halfsilver::bench
