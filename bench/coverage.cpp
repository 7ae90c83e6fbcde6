#include "bench/coverage.h"

#include <algorithm>
#include <bit>
#include <iostream>
#include <set>
#include <string>
#include <utility>

#include "bench/coverage_report.h"
#include "bench/points.h"
#include "bench/report.h"
#include "bench/tasks.h"
#include "bench/workbench.h"
#include "core/error.h"

namespace halfsilver::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSteps = 32;  // the paper's
constexpr int kRounds = 3;  // all points of a scene and preset, again and again

// In the order of measurement.
std::vector<int> steps(bool quick) {
  std::vector<int> all = scatteredOrder(kSteps);
  if (quick) std::erase_if(all, [](int step) { return !std::set{0, 1, 8, 16, kSteps}.contains(step); });
  return all;
}

Settings curveSettings(const std::string& preset, SelectPattern pattern, bool quick, std::size_t triangles) {
  Settings settings = presetSettings(preset, quick, triangles);
  if (settings.trace.method == Method::none) throw Error(ErrorKind::usage, "the preset " + preset + " traces nothing");
  settings.select.mode = SelectMode::all;
  settings.select.pattern = pattern;
  settings.abuffer.keep = false;  // what a frame costs whose scene moves
  return settings;
}

}  // namespace

std::vector<int> scatteredOrder(int last) {
  std::vector<int> order;
  const unsigned period = std::bit_ceil(static_cast<unsigned>(last) + 1);
  for (unsigned i = 0; i < period; ++i) {
    unsigned reversed = 0;
    for (unsigned bit = 1; bit < period; bit *= 2) reversed = 2 * reversed + ((i & bit) != 0);
    if (reversed <= static_cast<unsigned>(last)) order.push_back(static_cast<int>(reversed));
  }
  return order;
}

void runCoverage(const Request& request) {
  for (const std::string& preset : request.presets)
    curveSettings(preset, SelectPattern::region, request.quick, 0);  // a bad one must not show after an hour's work
  const std::vector<BenchScene> scenes = loadScenes(request);
  Workbench bench(request);
  const OutputFolder folder(request.folder);
  Points points(folder / "coverage.json", "coverage");

  std::vector<Task> tasks;
  const auto plan = [&](const BenchScene& scene, const std::string& preset, int round, int step,
                        SelectPattern pattern) {
    const std::size_t triangles = scene.model.scene.triangles.size();
    Settings settings = curveSettings(preset, pattern, request.quick, triangles);
    settings.select.fraction = static_cast<float>(step) / kSteps;
    Json key = pointKey(bench.describe(scene, settings), scene);
    key["preset"] = preset;
    key["round"] = round;
    const std::string label =
        scene.name + ", " + preset + ", " + std::to_string(step) + "/" + std::to_string(kSteps) + " of the screen";
    // Time grows with what is traced, above what every frame takes.
    const double work = (20000 + static_cast<double>(triangles)) * (8 + step);
    tasks.push_back({std::move(key), label, work, [&, settings, keeps = step == kSteps](Json& point) {
                       RunStatistics run = bench.describe(scene, settings);
                       bench.draw(scene, run);
                       addMeasured(point, run);
                       addTimes(point, run);
                       if (keeps) keepPicture(folder, scene.name, bench);
                     }});
  };
  for (const BenchScene& scene : scenes)
    for (const std::string& preset : request.presets)
      for (int round = 0; round < kRounds; ++round)
        for (const int step : steps(request.quick))
          for (const SelectPattern pattern : {SelectPattern::region, SelectPattern::scattered})
            plan(scene, preset, round, step, pattern);
  const PointList measured = measureAll(points, tasks);

  const CoverageCurves curves = coverageCurves(measured);
  writeReport(folder, {"coverage",
                       {{"coverage", coverageCsv(curves)}, {"coverage_fits", fitsCsv(curves)}},
                       [&](ChartFormat format) { return gnuplotScript(coverageChart(curves), format); },
                       [&](const std::optional<std::string>& svg) {
                         return coveragePage(curves, readPictures(folder, scenes), svg);
                       }});
  std::cout << toText(coverageSummary(curves));
  warnOfLostFragments(measured);
}

}  // namespace halfsilver::bench
