#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/chart.h"
#include "bench/report.h"
#include "bench/table.h"

// The points of the mode `scaling` as tables, charts and the text of its page.
namespace halfsilver::bench {

// Names of the scenes.
constexpr const char* kFinerTriangles = "finer triangles";
constexpr const char* kMoreObjects = "more objects";

// The points of one axis and preset, by value.
struct ScalingCurve {
  std::string axis, preset;
  PointList points;
};
using ScalingSeries = std::vector<ScalingCurve>;

// In the order in which they occur first.
ScalingSeries scalingSeries(const PointList& points);

// What is wrong with a point: the error that it ended with, fragments or rays that found no room, warnings. Nothing
// where all is well; its time does not matter.
std::optional<std::string> fault(const nlohmann::ordered_json& point);
// Whether larger points of its series are left out: it has a fault or took longer. `timeLimit` in seconds.
bool stops(const nlohmann::ordered_json& point, double timeLimit);

Table scalingCsv(const ScalingSeries& series);    // plain numbers, one row a point
Table exponentsCsv(const ScalingSeries& series);  // one row a curve and quantity
Table exponentsTable(const ScalingSeries& series);
Table limitsTable(const ScalingSeries& series, double timeLimit);  // where each preset stops, and how
PanelGrid scalingChart(const ScalingSeries& series);
std::string scalingBody(const ScalingSeries& series, const std::vector<ScenePicture>& pictures, double timeLimit,
                        const std::optional<std::string>& svg);

}  // namespace halfsilver::bench
