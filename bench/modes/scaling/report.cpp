#include "bench/modes/scaling/report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <tuple>
#include <utility>

#include "bench/report/text.h"

namespace halfsilver::bench {
namespace {

constexpr std::array kStages = {&Times::gbuffer, &Times::select, &Times::voxelize, &Times::build,
                                &Times::trace,   &Times::shade,  &Times::frame};
constexpr std::tuple kMemoryColumns{&MemoryReport::structureTotal, &MemoryReport::poolReserved,
                                    &MemoryReport::fragments,      &MemoryReport::fragmentsStored,
                                    &MemoryReport::gbuffer,        &MemoryReport::peak};
constexpr std::tuple kFrameColumns{&FrameRecord::lostFragments, &FrameRecord::overflow};

std::string lawText(const ScalingCurve& curve, const ScalingQuantity& quantity) {
  const std::vector<XY> points = lawSamples(curve, quantity);
  const std::optional<PowerLaw> law = fitPowerLaw(points);
  if (!law) return "none";
  std::string text = number(law->exponent, 2);
  if (law->first > 0) text += " from " + shortNumber(points[law->first].x);
  return text;
}

std::string howItStops(const ScalingPoint& point, double timeLimit) {
  if (const std::optional<std::string> why = fault(point)) return *why;
  return "took " + number(*point.seconds, 1) + " s, above the limit of " + secondsText(timeLimit) +
         " s: larger ones were not tried";
}

}  // namespace

std::string shortNumber(double value) {
  const bool mega = value >= 999500, kilo = !mega && value >= 1000;
  const double scaled = value / (mega ? 1e6 : kilo ? 1e3 : 1);
  std::string text = number(scaled, scaled >= 99.5 || scaled == std::floor(scaled) ? 0 : scaled >= 9.95 ? 1 : 2);
  return text += mega ? "M" : kilo ? "k" : "";
}

std::string secondsText(double seconds) {
  std::ostringstream text;
  text << seconds;
  return text.str();
}

Table scalingCsv(const ScalingSeries& series) {
  Table table{{"axis", "preset", "value", "triangles", "lights", "width", "height", "bounces", "selected"}, {}};
  for (const auto stage : kStages) table.columns.push_back(keyOf(stage) + "_ms");
  addKeys(table.columns, kMemoryColumns);
  addKeys(table.columns, kFrameColumns);
  for (const char* name : {"seconds", "fault"}) table.columns.emplace_back(name);
  for (const ScalingCurve& curve : series)
    for (const ScalingPoint& point : curve.points) {
      std::vector<std::string> row = {curve.axis,
                                      curve.preset,
                                      exactText(point.value),
                                      exactText(point.triangles),
                                      std::to_string(point.scene.lights),
                                      std::to_string(point.size.width),
                                      std::to_string(point.size.height),
                                      std::to_string(point.settings.trace.bounces)};
      if (!point.failed && point.frame) {
        row.push_back(std::to_string(point.frame->pixels.selected));
        for (const auto stage : kStages) row.push_back(number((point.frame->times.*stage).median, 4));
        addValues(row, point.frame->memory, kMemoryColumns);
        addValues(row, *point.frame, kFrameColumns);
      }
      row.resize(table.columns.size() - 2);
      row.push_back(exactText(point.seconds));
      row.push_back(fault(point).value_or(""));
      table.rows.push_back(std::move(row));
    }
  return table;
}

Table exponentsCsv(const ScalingSeries& series) {
  Table table{{"axis", "preset", "quantity", "exponent", "r_squared", "from", "to", "points"}, {}};
  for (const ScalingCurve& curve : series)
    for (const ScalingQuantity& quantity : kScalingQuantities) {
      const std::vector<XY> points = lawSamples(curve, quantity);
      const std::optional<PowerLaw> law = fitPowerLaw(points);
      std::vector<std::string> row = {curve.axis, curve.preset, quantity.name};
      if (law)
        row.insert(row.end(), {number(law->exponent, 4), law->rSquared ? number(*law->rSquared, 4) : "",
                               number(points[law->first].x, 3), number(points.back().x, 3),
                               std::to_string(points.size() - law->first)});
      row.resize(table.columns.size());
      table.rows.push_back(std::move(row));
    }
  return table;
}

Table exponentsTable(const ScalingSeries& series) {
  Table table{{"axis", "method"}, {}};
  for (const ScalingQuantity& quantity : kScalingQuantities) table.columns.emplace_back(quantity.name);
  for (const ScalingCurve& curve : series) {
    std::vector<std::string> row = {curve.axis, curve.preset};
    for (const ScalingQuantity& quantity : kScalingQuantities) row.push_back(lawText(curve, quantity));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table limitsTable(const ScalingSeries& series, double timeLimit) {
  Table table{{"axis", "method", "works up to", "ends at", "how"}, {}};
  for (const ScalingCurve& curve : series) {
    std::vector<std::string> row = {curve.axis, curve.preset, "", "", "no end was found"};
    for (const ScalingPoint& point : curve.points) {
      const std::string value = shortNumber(point.value);
      if (!fault(point)) row[2] = value;
      if (!stops(point, timeLimit)) continue;
      row[3] = value;
      row[4] = howItStops(point, timeLimit);
      break;
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

PanelGrid scalingChart(const ScalingSeries& series) {
  PanelGrid grid{3, {}};
  for (const ScalingAxis& axis : kScalingAxes)
    for (const ScalingQuantity& quantity : {kScalingQuantities[0], kScalingQuantities[1], kScalingQuantities[3]}) {
      Panel panel{std::string(quantity.name) + " by " + axis.name,
                  axis.label,
                  std::string(quantity.name) + ", " + quantity.unit,
                  {},
                  true,
                  {}};
      std::size_t color = 0;
      for (const ScalingCurve& curve : series) {
        if (curve.axis != axis.name) continue;
        const std::vector<XY> points = lawSamples(curve, quantity);
        Curve marks{curve.preset, {}, color, true};
        for (const XY& point : points) marks.samples.push_back({point.x, point.y, point.y, point.y});
        panel.curves.push_back(std::move(marks));
        if (const std::optional<PowerLaw> law = fitPowerLaw(points)) {
          Curve line{"", {}, color, false};
          for (const double x : {points[law->first].x, points.back().x})
            line.samples.push_back({x, law->at(x), law->at(x), law->at(x)});
          panel.curves.push_back(std::move(line));
        }
        for (const ScalingPoint& point : curve.points) {
          const double value = point.value;
          const auto same = [&](const Tick& tick) { return tick.at == value; };
          if (std::none_of(panel.ticks.begin(), panel.ticks.end(), same))
            panel.ticks.push_back({value, shortNumber(value)});
        }
        ++color;
      }
      if (!panel.curves.empty()) grid.panels.push_back(std::move(panel));
    }
  return grid;
}

}  // namespace halfsilver::bench
