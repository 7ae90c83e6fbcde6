#include "bench/modes/demo/report.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "bench/report/charts/gnuplot.h"
#include "bench/report/text.h"

namespace halfsilver::bench {
namespace {

constexpr std::size_t kFirst = 50;  // frames that do not count, if there are twice as many
constexpr double kSteady = 2;       // times the median

// One of the frames' figures, as a line over the frames.
template <class Value>
Curve curveOf(const DemoPoint& point, const std::string& name, std::size_t color, Value&& value) {
  Curve curve{.name = name, .samples = {}, .color = color, .measured = true, .marks = false};
  for (const DemoFrame& frame : point.frames) {
    const double y = value(frame);
    curve.samples.push_back({static_cast<double>(frame.frame), y, y, y});
  }
  return curve;
}

double timeOf(const DemoFrame& frame, const std::string& stage) {
  const auto time = frame.times.find(stage);
  return time == frame.times.end() ? 0 : time->second;
}

Panel timePanel(const DemoPoint& point) {
  Panel panel{point.preset + ": the game", "frame", "ms", {}};
  panel.curves.push_back(
      curveOf(point, "whole", kNeutralColor, [](const DemoFrame& frame) { return frame.wallMilliseconds; }));
  std::size_t color = 0;
  for (const char* stage : {"pose", "gbuffer", "trace", "shade", "build", "shadow"})
    panel.curves.push_back(
        curveOf(point, stage, color++, [&](const DemoFrame& frame) { return timeOf(frame, stage); }));
  return panel;
}

Panel memoryPanel(const DemoPoint& point) {
  Panel panel{point.preset + ": memory", "frame", "MB", {}};
  panel.curves.push_back(curveOf(point, "in all", kNeutralColor,
                                 [](const DemoFrame& f) { return 1e-6 * static_cast<double>(f.totalBytes); }));
  panel.curves.push_back(
      curveOf(point, "structure", 0, [](const DemoFrame& f) { return 1e-6 * static_cast<double>(f.structureBytes); }));
  return panel;
}

Panel coveragePanel(const DemoPoint& point) {
  Panel panel{point.preset + ": screen coverage and what was held", "frame", "%", {}};
  panel.curves.push_back(curveOf(point, "coverage", 0, [](const DemoFrame& f) { return 100 * f.coverage; }));
  panel.curves.push_back(curveOf(point, "traced share", 1, [](const DemoFrame& f) { return 100 * f.tracedShare; }));
  panel.curves.push_back(curveOf(point, "scale", 2, [](const DemoFrame& f) { return 100 * f.scale; }));
  return panel;
}

constexpr std::tuple kColumns{&DemoFrame::frame,       &DemoFrame::wallMilliseconds, &DemoFrame::scale,
                              &DemoFrame::tracedShare, &DemoFrame::coverage,         &DemoFrame::rays,
                              &DemoFrame::overflow,    &DemoFrame::structureBytes,   &DemoFrame::totalBytes};
constexpr std::array kStages = {"frame",    "pose",  "gbuffer", "shadow", "select",
                                "voxelize", "build", "trace",   "shade",  "composite"};

constexpr const char* kIntroduction =
    "The game, played by a recording of its input with a fixed time step: every method draws the same frames.";

constexpr const char* kMeasures =
    "Times are those of a whole frame, posing and upload included. Steady: the share of the frames within twice the "
    "median. Growth: by how much the memory of any later frame exceeds that of the first one that counts. The first 50 "
    "frames do not count in a run of at least 100: they compile shaders and reserve memory. The scale is the "
    "resolution per axis that the controller of the frame time chose, the share that of the reflecting pixels that it "
    "had traced.";

}  // namespace

DemoSummary summarize(const DemoPoint& point) {
  const std::size_t first = point.frames.size() >= 2 * kFirst ? kFirst : 0;
  const std::span<const DemoFrame> frames = std::span(point.frames).subspan(first);
  DemoSummary summary;
  if (frames.empty()) return summary;
  std::vector<double> times;
  for (const DemoFrame& frame : frames) {
    times.push_back(frame.wallMilliseconds);
    summary.meanCoverage += frame.coverage / static_cast<double>(frames.size());
    summary.lowestScale = std::min(summary.lowestScale, frame.scale);
    summary.lowestShare = std::min(summary.lowestShare, frame.tracedShare);
    summary.mostStructure = std::max(summary.mostStructure, frame.structureBytes);
    summary.mostTotal = std::max(summary.mostTotal, frame.totalBytes);
    summary.overflow += frame.overflow;
  }
  summary.growth = static_cast<std::int64_t>(summary.mostTotal) - static_cast<std::int64_t>(frames[0].totalBytes);
  std::sort(times.begin(), times.end());
  summary.median = times[times.size() / 2];
  summary.percentile99 = times[(times.size() - 1) * 99 / 100];
  const auto slow = std::upper_bound(times.begin(), times.end(), kSteady * summary.median);
  summary.steady = static_cast<double>(slow - times.begin()) / static_cast<double>(times.size());
  return summary;
}

Table demoCsv(DemoPoints points) {
  Table table{{"replay", "method"}, {}};
  addKeys(table.columns, kColumns);
  for (const char* stage : kStages) table.columns.push_back(std::string(stage) + "_ms");
  for (const DemoPoint& point : points)
    for (const DemoFrame& frame : point.frames) {
      std::vector<std::string> row = {point.scene.file, point.preset};
      addValues(row, frame, kColumns);
      for (const char* stage : kStages) row.push_back(exactText(timeOf(frame, stage)));
      table.rows.push_back(std::move(row));
    }
  return table;
}

Table demoTable(DemoPoints points) {
  Table table{{"Method", "Frames", "Median, ms", "99 %, ms", "Steady", "Coverage", "Structure, MB", "In all, MB",
               "Growth, MB", "Overflow", "Lowest scale", "Lowest share"},
              {}};
  for (const DemoPoint& point : points) {
    const DemoSummary summary = summarize(point);
    table.rows.push_back(
        {point.preset, std::to_string(point.frames.size()), number(summary.median, 1), number(summary.percentile99, 1),
         percent(summary.steady), percent(summary.meanCoverage), megabytes(static_cast<double>(summary.mostStructure)),
         megabytes(static_cast<double>(summary.mostTotal)), megabytes(static_cast<double>(summary.growth)),
         std::to_string(summary.overflow), number(summary.lowestScale, 2), percent(summary.lowestShare)});
  }
  return table;
}

PanelGrid demoChart(DemoPoints points) {
  PanelGrid grid{3, {}};
  for (const DemoPoint& point : points)
    for (Panel& panel : std::array{timePanel(point), memoryPanel(point), coveragePanel(point)})
      grid.panels.push_back(std::move(panel));
  return grid;
}

std::string demoBody(DemoPoints points, const std::vector<Figure>& pictures, const std::optional<std::string>& svg) {
  return paragraph(kIntroduction) + gallery(pictures) + heading("Frame by frame") + chartFigure(svg, kMeasures) +
         heading("In all") + toHtml(demoTable(points));
}

}  // namespace halfsilver::bench
