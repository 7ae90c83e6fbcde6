#include "bench/modes/coverage/report.h"

#include <array>
#include <string_view>
#include <tuple>
#include <utility>

#include "bench/report/text.h"

namespace halfsilver::bench {
namespace {

constexpr std::array kStages = {&Times::voxelize, &Times::build, &Times::trace, &Times::frame};
constexpr std::tuple kMemoryColumns{&MemoryReport::structureTotal, &MemoryReport::poolReserved, &MemoryReport::poolUsed,
                                    &MemoryReport::voxels,         &MemoryReport::heads,        &MemoryReport::peak};
constexpr std::tuple kFrameColumns{&FrameRecord::overflow, &FrameRecord::lostFragments};

Curve chartCurve(const std::string& name, const CoverageCurve& curve, const CoverageQuantity& quantity,
                 Timing Times::*stage, std::size_t color) {
  Curve result{name, {}, color};
  for (const CoveragePoint& point : curve.points) {
    const double y = quantity.of(point);
    result.samples.push_back(
        {100 * point.pixels.coverage, y, stage ? (point.times.*stage).min : y, stage ? (point.times.*stage).max : y});
  }
  return result;
}

std::optional<Curve> fittedCurve(const CoverageCurve& curve, const CoverageQuantity& quantity, std::size_t color) {
  const CoverageFit f = fitCurve(curve, quantity);
  if (!f.line) return std::nullopt;
  Curve result{"", {}, color, false};
  for (const double x : {f.points.front().x, f.points.back().x})
    result.samples.push_back({100 * x, f.line->at(x), f.line->at(x), f.line->at(x)});
  return result;
}

}  // namespace

std::string rSquaredText(const CoverageFit& fit) {
  if (!fit.line) return "";
  return fit.line->rSquared ? number(*fit.line->rSquared, 4) : "constant";
}

std::string smallShareText(const CoverageFit& fit) { return fit.smallShare ? percent(*fit.smallShare) : ""; }

Table coverageCsv(const CoverageCurves& curves) {
  Table table{{"scene", "preset", "pattern", "fraction", "coverage"}, {}};
  for (const auto stage : kStages)
    for (const char* suffix : {"_ms", "_ms_min", "_ms_max"}) table.columns.push_back(keyOf(stage) + suffix);
  addKeys(table.columns, kMemoryColumns);
  addKeys(table.columns, kFrameColumns);
  for (const CoverageCurve& curve : curves)
    for (const CoveragePoint& point : curve.points) {
      std::vector<std::string> row = {curve.scene, curve.preset, curve.pattern, number(shareOf(point), 5),
                                      number(point.pixels.coverage, 6)};
      for (const auto stage : kStages)
        for (const auto which : {&Timing::median, &Timing::min, &Timing::max})
          row.push_back(number(point.times.*stage.*which, 4));
      addValues(row, point.memory, kMemoryColumns);
      addValues(row, point, kFrameColumns);
      table.rows.push_back(std::move(row));
    }
  return table;
}

Table fitsCsv(const CoverageCurves& curves) {
  Table table{{"scene", "preset", "pattern", "quantity", "unit", "slope", "intercept", "r_squared", "residual",
               "small_share_over_whole", "jump_from", "jump_to", "jump_excess", "jump_median_steps"},
              {}};
  for (const CoverageCurve& curve : curves)
    for (const CoverageQuantity& quantity : kCoverageQuantities) {
      const CoverageFit f = fitCurve(curve, quantity);
      std::vector<std::string> row = {curve.scene, curve.preset, curve.pattern, quantity.name, quantity.unit};
      const auto add = [&](bool known, auto value) { row.push_back(known ? number(value(), 6) : ""); };
      add(f.line.has_value(), [&] { return f.line->slope; });
      add(f.line.has_value(), [&] { return f.line->intercept; });
      add(f.line && f.line->rSquared, [&] { return *f.line->rSquared; });
      add(f.line.has_value(), [&] { return f.line->residual; });
      add(f.smallShare.has_value(), [&] { return *f.smallShare; });
      add(f.jump.has_value(), [&] { return f.points[f.jump->first].x; });
      add(f.jump.has_value(), [&] { return f.points[f.jump->first + 1].x; });
      add(f.jump.has_value(), [&] { return f.jump->excess; });
      add(f.jump.has_value(), [&] { return f.jump->medianSteps; });
      table.rows.push_back(std::move(row));
    }
  return table;
}

Table coverageSummary(const CoverageCurves& curves) {
  Table table{{"scene", "method", "pattern", "R^2 of trace", "3 % : 100 % of time", "of memory"}, {}};
  for (const CoverageCurve& curve : curves) {
    const CoverageFit trace = fitCurve(curve, kTrace), all = fitCurve(curve, kReflections),
                      held = fitCurve(curve, kStructure);
    table.rows.push_back(
        {curve.scene, curve.preset, curve.pattern, rSquaredText(trace), smallShareText(all), smallShareText(held)});
  }
  return table;
}

PanelGrid coverageChart(const CoverageCurves& curves) {
  PanelGrid grid{3, {}};
  const std::string xAxis = "% of the screen traced";
  for (const CoverageCurve& region : curves) {
    if (region.pattern != kRegion) continue;
    const std::string title = region.scene + ", " + region.preset;
    Panel trace{title, xAxis, "trace, ms", {}}, total{title, xAxis, "frame, ms", {}},
        held{title, xAxis, "structure, MB", {}};
    std::size_t color = 0;
    for (const std::string_view pattern : {kRegion, kScattered}) {
      const CoverageCurve* curve = sibling(curves, region, pattern);
      if (!curve) continue;
      trace.curves.push_back(chartCurve(std::string(pattern), *curve, kTrace, &Times::trace, color));
      if (const std::optional<Curve> line = fittedCurve(*curve, kTrace, color)) trace.curves.push_back(*line);
      total.curves.push_back(chartCurve(std::string(pattern), *curve, kFrame, &Times::frame, color));
      held.curves.push_back(chartCurve(std::string(pattern), *curve, kStructure, nullptr, color));
      held.curves.push_back(chartCurve(std::string(pattern) + ", pool used", *curve, kPool, nullptr, color + 2));
      ++color;
    }
    for (Panel& panel : std::array{trace, total, held}) grid.panels.push_back(std::move(panel));
  }
  return grid;
}

}  // namespace halfsilver::bench
