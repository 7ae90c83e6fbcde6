#include "bench/modes/coverage/coverage.h"

#include <algorithm>
#include <bit>
#include <set>
#include <string>
#include <utility>

#include <halfsilver/error.h>
#include "bench/harness/method_presets.h"
#include "bench/modes/coverage/report.h"
#include "bench/report/text.h"

namespace halfsilver::bench {
namespace {

constexpr int kSteps = 32;  // the paper's
constexpr int kRounds = 3;  // each measures all points of a scene and preset

// All surfaces are traced, so the picture is not that of other modes.
std::string pictureName(const std::string& scene) { return scene + " all traced"; }

// In order of measurement.
std::vector<int> steps(bool few) {
  std::vector<int> all = scatteredOrder(kSteps);
  if (few) std::erase_if(all, [](int step) { return !std::set{0, 1, 8, 16, kSteps}.contains(step); });
  return all;
}

Settings curveSettings(const std::string& preset, SelectPattern pattern, bool quick, std::size_t triangles) {
  Settings settings = presetSettings(preset, quick, triangles);
  if (settings.trace.method == "none") throw Error(ErrorKind::usage, "the preset " + preset + " traces nothing");
  settings.select.mode = SelectMode::all;
  settings.select.pattern = pattern;
  settings.identity.keep = false;  // as for a moving scene
  return settings;
}

Plan planCoverage(const Setup& setup) {
  const Request& request = setup.request;
  std::vector<Task<CoveragePoint>> tasks;
  const auto add = [&](const BenchScene& scene, const std::string& preset, int round, int step, SelectPattern pattern) {
    const std::size_t triangles = scene.model.scene.triangles.size();
    Settings settings = curveSettings(preset, pattern, setup.request.quick, triangles);
    settings.select.fraction = static_cast<float>(step) / kSteps;
    const std::string label =
        scene.name + ", " + preset + ", " + std::to_string(step) + "/" + std::to_string(kSteps) + " of the screen";
    const auto measure = [&scene, &bench = setup.bench, &folder = setup.folder, settings, step] {
      RunStatistics run = bench.describe(scene, settings);
      bench.draw(scene, run);
      if (step == kSteps) savePicture(folder, pictureName(scene.name), bench);
      return timedFrame(run);
    };
    // Time grows with the traced share, above what every frame takes.
    tasks.push_back({.key = {pointKey(setup.bench.describe(scene, settings), scene, preset), round},
                     .label = label,
                     .work = workOf(0.1 * (8 + step), triangles),
                     .measure = measure});
  };
  for (const BenchScene& scene : setup.scenes)
    for (const std::string& preset :
         chosenPresets(request, methodPresets(request.quick, scene.model.scene.triangles.size(), false))) {
      // All methods at all shares would take hours: where none was asked for, only the default has them.
      const bool few = request.quick || (request.presets.empty() && preset != kDefaultPreset);
      for (int round = 0; round < kRounds; ++round)
        for (const int step : steps(few))
          for (const SelectPattern pattern : {SelectPattern::region, SelectPattern::scattered})
            add(scene, preset, round, step, pattern);
    }
  const auto report = [&folder = setup.folder, &scenes = setup.scenes](const std::vector<CoveragePoint>& points) {
    const CoverageCurves curves = coverageCurves(points);
    const ChartFiles chart = drawChart(coverageChart(curves));
    std::vector<CoveragePoint> whole;  // the points of the largest share
    for (const CoverageCurve& curve : curves) whole.push_back(curve.points.back());
    const auto coverage = [](const CoveragePoint& point) {
      return ", a surface in " + percent(point.pixels.coverage) + " of the pixels";
    };
    return Report{.title = "What it costs to trace a part of the screen",
                  .tables = {{"coverage", coverageCsv(curves)}, {"coverage_fits", fitsCsv(curves)}},
                  .chart = chart,
                  .body = coverageBody(curves, sceneFigures(folder, scenes, whole, coverage, pictureName), chart.svg),
                  .summary = coverageSummary(curves),
                  .warnings = lostFragments(points)};
  };
  return makePlan<CoveragePoint>(std::move(tasks), report);
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
