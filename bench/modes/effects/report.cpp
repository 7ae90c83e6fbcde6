#include "bench/modes/effects/report.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "bench/harness/output_folder.h"
#include "bench/report/charts/gnuplot.h"
#include "bench/report/page.h"
#include "bench/report/text.h"

namespace halfsilver::bench {
namespace {

constexpr std::tuple kColumns{&EffectResult::rays, &EffectResult::microsecondsPerRay, &EffectResult::rmse};

constexpr const char* kIntroduction =
    "Each scene is drawn with every effect, over the default method and over exact rays on the CPU, with few and with "
    "many rays per pixel. The truth of an effect is the same effect over exact rays with many samples: 64 of glossy "
    "reflections and shadow rays, the most that they take, 1,024 (128 in a quick run) of what has passes. The first of "
    "them are those that are measured, so errors are a little more than said, most of all those of 16 samples of 64.";

constexpr const char* kCaption =
    "Time of a frame against its error, both on logarithmic axes; a row below the axis holds the marks whose error is "
    "exactly 0. Filled marks are the default method's, hollow ones those of exact rays on the CPU; beside a mark "
    "stands "
    "how many rays per pixel choose at random.";

constexpr const char* kMeasures =
    "<ul>\n<li><b>Frame</b>: the GPU's time of a frame whose structure and shadow maps are kept, median of "
    "three.</li>\n"
    "<li><b>Per ray</b>: the time of the stage <code>trace</code> over the rays of all kinds.</li>\n"
    "<li><b>Error</b>: root of the mean squared difference from the truth, of radiance clipped to 0 to 1. Effects that "
    "choose nothing at random have the error of the method alone; both methods of a pair differ by "
    "theirs.</li>\n</ul>\n";

std::vector<std::string> namesOf(EffectPoints points, std::string EffectPoint::*name) {
  std::vector<std::string> names;
  for (const EffectPoint& point : points)
    if (std::find(names.begin(), names.end(), point.*name) == names.end()) names.push_back(point.*name);
  return names;
}

std::size_t placeOf(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

}  // namespace

Table effectsTable(EffectPoints points) {
  Table table{{"scene", "effect", "method", "samples", "rays", "frame ms", "trace ms", "us per ray", "error"}, {}};
  for (const EffectPoint& point : points)
    table.rows.push_back({point.scene.file, point.effect, point.method, std::to_string(point.samples),
                          std::to_string(point.rays), number(point.times.frame.median, 1),
                          number(point.times.trace.median, 1), number(point.microsecondsPerRay, 3),
                          number(point.rmse, 5)});
  return table;
}

Table effectsCsv(EffectPoints points) {
  Table table{{"scene", "effect", "method", "samples", "truth_samples", "frame_ms", "trace_ms"}, {}};
  addKeys(table.columns, kColumns);
  for (const EffectPoint& point : points) {
    std::vector<std::string> row = {point.scene.file,
                                    point.effect,
                                    point.method,
                                    std::to_string(point.samples),
                                    std::to_string(point.truthSamples),
                                    number(point.times.frame.median, 4),
                                    number(point.times.trace.median, 4)};
    addValues(row, point, kColumns);
    table.rows.push_back(std::move(row));
  }
  return table;
}

ScatterGrid effectsChart(EffectPoints points) {
  const std::vector<std::string> effects = namesOf(points, &EffectPoint::effect);
  constexpr std::size_t kPerRow = 4;
  ScatterGrid grid{2, {}, {}};
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (i % kPerRow == 0) grid.legend.emplace_back();
    grid.legend.back().push_back({0, 0, 1, i, false, false, effects[i]});
  }
  grid.legend.push_back({{0, 0, 1, kNeutralColor, false, false, "default method"},
                         {0, 0, 1, kNeutralColor, true, false, "exact rays, CPU"}});
  for (const EffectPoint& point : points) {
    if (grid.panels.empty() || grid.panels.back().title != point.scene.file)
      grid.panels.push_back({point.scene.file, "frame, ms", "error (RMSE)", {}, {}});
    Mark mark{point.times.frame.median, point.rmse, 1, placeOf(effects, point.effect), false, false, ""};
    mark.hollow = point.method == kExactRays;
    if (point.samples > 1) mark.label = std::to_string(point.samples);
    grid.panels.back().marks.push_back(std::move(mark));
  }
  return grid;
}

std::string effectsBody(EffectPoints points, const std::map<std::string, std::string>& pictures,
                        const std::optional<std::string>& svg) {
  std::string body = paragraph(kIntroduction);
  body += chartFigure(svg, kCaption) + toHtml(effectsTable(points)) + kMeasures;
  std::vector<Figure> figures;
  for (const auto& [name, picture] : pictures) figures.push_back({picture, name});
  return body + heading("The truth of each") + gallery(figures);
}

}  // namespace halfsilver::bench
