#include "bench/coverage.h"

#include <algorithm>
#include <bit>
#include <set>
#include <string>
#include <utility>

#include <halfsilver/error.h>
#include "bench/coverage_report.h"
#include "bench/points.h"
#include "bench/report.h"
#include "bench/tasks.h"
#include "bench/workbench.h"

namespace halfsilver::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSteps = 32;  // the paper's
constexpr int kRounds = 3;  // all points of a scene and preset, again and again

// Every surface is traced, so it is not the picture of other modes.
std::string pictureName(const std::string& scene) { return scene + " all traced"; }

// In the order of measurement.
std::vector<int> steps(bool quick) {
  std::vector<int> all = scatteredOrder(kSteps);
  if (quick) std::erase_if(all, [](int step) { return !std::set{0, 1, 8, 16, kSteps}.contains(step); });
  return all;
}

Settings curveSettings(const std::string& preset, SelectPattern pattern, bool quick, std::size_t triangles) {
  Settings settings = presetSettings(preset, quick, triangles);
  if (settings.trace.method == "none") throw Error(ErrorKind::usage, "the preset " + preset + " traces nothing");
  settings.select.mode = SelectMode::all;
  settings.select.pattern = pattern;
  settings.identity.keep = false;  // what a frame costs whose scene moves
  return settings;
}

Plan planCoverage(const Setup& setup) {
  const std::vector<std::string> presets = chosenPresets(setup.request, {kDefaultPreset});
  Plan plan;
  const auto add = [&](const BenchScene& scene, const std::string& preset, int round, int step, SelectPattern pattern) {
    const std::size_t triangles = scene.model.scene.triangles.size();
    Settings settings = curveSettings(preset, pattern, setup.request.quick, triangles);
    settings.select.fraction = static_cast<float>(step) / kSteps;
    Json key = pointKey(setup.bench.describe(scene, settings), scene);
    key["preset"] = preset;
    key["round"] = round;
    const std::string label =
        scene.name + ", " + preset + ", " + std::to_string(step) + "/" + std::to_string(kSteps) + " of the screen";
    // Time grows with what is traced, above what every frame takes.
    plan.tasks.push_back(
        {std::move(key), label, workOf(0.1 * (8 + step), triangles),
         [&scene, &bench = setup.bench, &folder = setup.folder, settings, keeps = step == kSteps](Json& point) {
           RunStatistics run = bench.describe(scene, settings);
           bench.draw(scene, run);
           addMeasured(point, run);
           addTimes(point, run);
           if (keeps) keepPicture(folder, pictureName(scene.name), bench);
         }});
  };
  for (const BenchScene& scene : setup.scenes)
    for (const std::string& preset : presets)
      for (int round = 0; round < kRounds; ++round)
        for (const int step : steps(setup.request.quick))
          for (const SelectPattern pattern : {SelectPattern::region, SelectPattern::scattered})
            add(scene, preset, round, step, pattern);
  plan.report = [&folder = setup.folder, &scenes = setup.scenes](const PointList& points) {
    const CoverageCurves curves = coverageCurves(points);
    const ChartFiles chart = drawChart(coverageChart(curves));
    return Report{.title = "What it costs to trace a part of the screen",
                  .tables = {{"coverage", coverageCsv(curves)}, {"coverage_fits", fitsCsv(curves)}},
                  .chart = chart,
                  .body = coverageBody(curves, readPictures(folder, scenes, pictureName), chart.svg),
                  .summary = coverageSummary(curves),
                  .warnings = lostFragments(points)};
  };
  return plan;
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

Mode coverageMode() {
  return {.name = "coverage",
          .description = "What a frame costs as more and more of the screen is traced",
          .takesPresets = true,
          .plan = planCoverage};
}

}  // namespace halfsilver::bench
