#include "bench/modes/pareto/report.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "bench/harness/request.h"
#include "bench/report/charts/gnuplot.h"
#include "bench/report/text.h"

namespace halfsilver::bench {
namespace {

constexpr std::tuple kMemoryColumns{&MemoryReport::structureTotal, &MemoryReport::peak};
constexpr std::tuple kRayColumns{&CommonRays::rays, &CommonRays::share, &CommonRays::hitError, &CommonRays::falseMiss,
                                 &CommonRays::falseHit};
constexpr std::tuple kPictureColumns{&PictureErrors::perceptible, &PictureErrors::rmse};
constexpr std::tuple kFrameColumns{&FrameRecord::overflow, &FrameRecord::lostFragments};

ScatterPanel panel(const ParetoScene& scene, Accuracy accuracy, const std::vector<std::string>& families) {
  const bool shares = accuracy == Accuracy::hits || perceptionKnown({&scene, 1});
  ScatterPanel panel{scene.name, "frame, ms", accuracyName(accuracy, {&scene, 1}), {}, {}};
  if (shares) panel.yAxis += ", %";
  const double unit = shares ? 100 : 1;
  const std::vector<std::size_t> front = frontOf(scene, accuracy);
  for (std::size_t i = 0; i < scene.variants.size(); ++i) {
    const ParetoVariant& variant = scene.variants[i];
    const std::optional<double> error = errorOf(variant, accuracy);
    if (!error) continue;
    const bool own = variant.name == kDefaultPreset;
    Mark mark{
        frameTime(variant).median, unit * *error, markRadius(variant.bytes()), 0, !variant.beside.empty(), own, ""};
    mark.color =
        static_cast<std::size_t>(std::find(families.begin(), families.end(), variant.family) - families.begin());
    if (own)
      mark.label = "default";
    else if (onFront(scene, i, accuracy) || mark.hollow || variant.errors.share < 1)
      mark.label = variant.knob.empty() ? variant.family : variant.knob;
    panel.marks.push_back(std::move(mark));
  }
  for (const std::size_t i : front)
    panel.front.push_back({frameTime(scene.variants[i]).median, unit * *errorOf(scene.variants[i], accuracy), 0, 0});
  return panel;
}

std::vector<std::string> familiesOf(ParetoScenes scenes) {
  std::vector<std::string> families;
  for (const ParetoScene& scene : scenes)
    for (const ParetoVariant& variant : scene.variants)
      if (std::find(families.begin(), families.end(), variant.family) == families.end())
        families.push_back(variant.family);
  return families;
}

}  // namespace

bool perceptionKnown(ParetoScenes scenes) { return scenes.front().variants.front().errors.perceptible.has_value(); }

const char* accuracyName(Accuracy accuracy, ParetoScenes scenes) {
  if (accuracy == Accuracy::hits) return "wrong hits";
  return perceptionKnown(scenes) ? "perceptible pixels" : "difference of the pictures (RMSE)";
}

std::string optionalPercent(const std::optional<double>& share) { return share ? percent(*share, 3) : ""; }

std::string standing(const ParetoScene& scene, std::size_t at, Accuracy accuracy) {
  const ParetoVariant& variant = scene.variants[at];
  if (!variant.beside.empty()) return "beside: " + variant.beside;
  if (!competes(variant, accuracy)) return "traces fewer rays";
  if (onFront(scene, at, accuracy)) return "on the front";
  if (const auto other = beatenBy(scene, at, accuracy)) return "behind " + scene.variants[*other].name;
  return "within the noise";
}

double markRadius(double bytes) { return 0.6 + 0.5 * std::log10(std::max(1.0, bytes / 1e6)); }

Table paretoCsv(ParetoScenes scenes) {
  Table table{{"scene", "variant", "family", "knob", "beside", "rounds", "frame_ms", "frame_ms_min", "frame_ms_max",
               "over_default", "over_default_min", "over_default_max"},
              {}};
  addKeys(table.columns, kMemoryColumns);
  addKeys(table.columns, kRayColumns);
  addKeys(table.columns, kPictureColumns);
  for (const char* name : {"on_front_of_hits", "on_front_of_pictures"}) table.columns.emplace_back(name);
  addKeys(table.columns, kFrameColumns);
  for (const ParetoScene& scene : scenes) {
    const std::optional<std::size_t> own = defaultOf(scene);
    for (std::size_t i = 0; i < scene.variants.size(); ++i) {
      const ParetoVariant& variant = scene.variants[i];
      std::vector<std::string> row = {scene.name,   variant.name,   variant.family,
                                      variant.knob, variant.beside, std::to_string(variant.frames.size())};
      const auto addSpread = [&](const Spread& spread) {
        for (const double value : {spread.median, spread.min, spread.max}) row.push_back(number(value, 4));
      };
      addSpread(frameTime(variant));
      addSpread(own ? pairedRatio(variant, scene.variants[*own]) : Spread());
      addValues(row, variant.first.memory, kMemoryColumns);
      addValues(row, variant.errors, kRayColumns);
      addValues(row, variant.errors, kPictureColumns);
      for (const Accuracy accuracy : kAccuracies) row.emplace_back(onFront(scene, i, accuracy) ? "true" : "false");
      addValues(row, variant.first, kFrameColumns);
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

Table paretoSummary(ParetoScenes scenes) {
  Table table{{"scene", "variant", "frame ms", "times default", "structure MB", "wrong hits", "perceptible", "RMSE",
               "by hits", "by picture"},
              {}};
  for (const ParetoScene& scene : scenes) {
    const std::optional<std::size_t> own = defaultOf(scene);
    for (std::size_t i = 0; i < scene.variants.size(); ++i) {
      const ParetoVariant& variant = scene.variants[i];
      table.rows.push_back({scene.name, variant.name, number(frameTime(variant).median, 1),
                            own ? number(pairedRatio(variant, scene.variants[*own]).median, 2) : "",
                            megabytes(variant.bytes()), optionalPercent(variant.errors.hitError),
                            optionalPercent(variant.errors.perceptible), number(variant.errors.rmse, 5),
                            standing(scene, i, Accuracy::hits), standing(scene, i, Accuracy::picture)});
    }
  }
  return table;
}

ScatterGrid paretoChart(ParetoScenes scenes) {
  const std::vector<std::string> families = familiesOf(scenes);
  ScatterGrid grid{kAccuracies.size(), {{}, {}}, {}};
  for (std::size_t i = 0; i < families.size(); ++i) grid.legend[0].push_back({0, 0, 1, i, false, false, families[i]});
  constexpr std::size_t gray = kNeutralColor;
  for (const double size : {1e6, 1e7, 1e8, 1e9})
    grid.legend[1].push_back({0, 0, markRadius(size), gray, false, false, number(size / 1e6, 0) + " MB"});
  grid.legend[1].push_back({0, 0, 1, gray, true, false, "beside the comparison"});
  grid.legend[1].push_back({0, 0, 1, 0, false, true, "the default"});
  for (const ParetoScene& scene : scenes)
    for (const Accuracy accuracy : kAccuracies) grid.panels.push_back(panel(scene, accuracy, families));
  return grid;
}

}  // namespace halfsilver::bench
