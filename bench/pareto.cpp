#include "bench/pareto.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include <halfsilver/methods.h>
#include "apps/drawing.h"
#include "bench/pareto_report.h"
#include "bench/points.h"
#include "bench/report.h"
#include "bench/tasks.h"
#include "bench/truth.h"
#include "bench/workbench.h"

namespace halfsilver::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFewestRounds = 2, kMostRounds = 5;
constexpr double kMeasuredMilliseconds = 1000 * kParetoSeconds;
constexpr int kMostBounces = 4;

// One mark of the chart: a preset with some settings changed.
struct Variant {
  std::string family, knob;  // "halfsilver", "2 voxels a triangle"; no knob: the preset as it is
  std::string preset;
  std::vector<std::pair<std::string, std::string>> values;  // as after --set
  bool quick = false;                                       // also measured by --quick
  std::string beside;                                       // why it does not compete; empty where it does

  std::string name() const {
    std::string text = family;
    if (!knob.empty()) text += ", ";
    text += knob;
    return text;
  }
};

std::vector<Variant> variants(bool quick, std::size_t triangles) {
  const std::string kastrati = "kastrati2017", hu = "hu2014", share = "share of the pixels";
  const int voxels = presetSettings(kastrati, quick, triangles).voxels.resolution;
  const std::string half = std::to_string(voxels / 2);
  std::vector<Variant> all = {
      {kDefaultPreset, "", kDefaultPreset, {}, true, ""},
      {kDefaultPreset, "2 voxels a triangle", kDefaultPreset, {{"voxels.per_triangle", "2"}}, false, ""},
      {kDefaultPreset, "64 voxels a triangle", kDefaultPreset, {{"voxels.per_triangle", "64"}}, false, ""},
      {kDefaultPreset, "kept", kDefaultPreset, {{"abuffer.keep", "true"}}, true, "builds nothing"},
      {kDefaultPreset, "2 bounces", kDefaultPreset, {{"trace.bounces", "2"}}, true, "draws more"},
      {kDefaultPreset, "4 bounces", kDefaultPreset, {{"trace.bounces", "4"}}, false, "draws more"},
      {kastrati, "", kastrati, {}, true, ""},
      {kastrati, "half the voxels", kastrati, {{"voxels.resolution", half}}, false, ""},
      {kastrati, "512 texels", kastrati, {{"abuffer.resolution", "512"}}, false, ""},
      {kastrati, "256 texels", kastrati, {{"abuffer.resolution", "256"}}, false, ""},
      {kastrati, "1 step", kastrati, {{"search.steps", "1"}}, false, ""},
      {kastrati, "256 texels, 1 step", kastrati, {{"abuffer.resolution", "256"}, {"search.steps", "1"}}, false, ""},
      {kastrati, "all steps", kastrati, {{"search.steps", "0"}}, false, ""},
      {kastrati, "512 texels, all steps", kastrati, {{"abuffer.resolution", "512"}, {"search.steps", "0"}}, false, ""},
      {kastrati,
       "fine voxel pass, all steps",
       kastrati,
       {{"voxels.raster", "abuffer"}, {"search.steps", "0"}},
       false,
       ""},
      {kastrati, "1 entry a page", kastrati, {{"abuffer.page_size", "1"}}, false, ""},
      {kastrati, "16 entries a page", kastrati, {{"abuffer.page_size", "16"}}, false, ""},
      {hu, "", hu, {}, true, ""},
      {hu, "reflective pixels", hu, {{"select.mode", "reflective"}}, false, ""},
      {hu, "half the voxels", hu, {{"voxels.resolution", half}}, false, ""},
      {hu, "512 texels", hu, {{"abuffer.resolution", "512"}}, false, ""},
      {hu, "256 texels", hu, {{"abuffer.resolution", "256"}}, false, ""},
      {hu, "1 step", hu, {{"search.steps", "1"}}, false, ""},
      {hu, "all steps", hu, {{"search.steps", "0"}}, false, ""},
      {"exact rays, CPU", "", kDefaultPreset, {{"trace.method", "exact"}}, true, "no GPU method"},
      {share, "1/4 of the pixels", kDefaultPreset, {{"select.fraction", "0.25"}}, true, ""},
      {share, "1/16 of the pixels", kDefaultPreset, {{"select.fraction", "0.0625"}}, false, ""},
      {share,
       "1/4 of the pixels, sky between",
       kDefaultPreset,
       {{"select.fraction", "0.25"}, {"select.fill", "sky"}},
       false,
       ""},
  };
  for (const char* threshold : {"0.01", "0.02", "0.05", "0.1", "0.2"})
    all.push_back({"threshold of contribution",
                   threshold,
                   kDefaultPreset,
                   {{"select.min_contribution", threshold}},
                   std::string(threshold) == "0.1",
                   ""});
  if (quick) std::erase_if(all, [](const Variant& variant) { return !variant.quick; });
  return all;
}

// All is built anew in each frame, as where the scene moves, but where a variant says otherwise.
Settings settingsOf(const Variant& variant, bool quick, std::size_t triangles) {
  Settings settings = presetSettings(variant.preset, quick, triangles);
  settings.identity.keep = false;
  for (const auto& [name, value] : variant.values) set(settings, name, value);
  return settings;
}

Json pictureErrors(const Image& layers, const Image& picture, const Truth::Frame& truth) {
  Json errors;
  errors["rmse"] = compareImages({picture, false, {}}, {truth.picture, false, {}}).rmse;
  errors["yee_fail_fraction"] = nullptr;
  if (const auto perceptual = comparePerceptually(layers, truth.layers))
    errors["yee_fail_fraction"] = perceptual->fraction;
  return errors;
}

class Measurement {
 public:
  Measurement(const OutputFolder& folder, Workbench& bench) : folder_(&folder), bench_(&bench), truth_(bench) {}

  // Adds the measured members to the point.
  void measure(const BenchScene& scene, const Variant& variant, const Settings& settings, int round, Json& point) {
    RunStatistics run = bench_->describe(scene, settings);
    bench_->draw(scene, run);
    addMeasured(point, run);
    addTimes(point, run);
    if (round > 0) return;  // every frame is the same to the bit
    if (variant.name() == kDefaultPreset) keepPicture(*folder_, scene.name, *bench_);
    const Image layers = bench_->layers(), picture = bench_->picture();
    const Truth::Frame& truth = truth_.of(scene, SelectMode::reflective, settings.trace.bounces);
    const CommonRays hits = compareCommonRays(layers, truth.layers, scene.diagonal);
    Json& errors = point["error"] = pictureErrors(layers, picture, truth);
    errors["rays"] = hits.rays;
    errors["rays_of_reference"] = hits.share;
    const auto add = [&](const char* name, const std::optional<double>& value) {
      errors[name] = value ? Json(*value) : Json();
    };
    add("hit_error", hits.hitError);
    add("false_miss", hits.falseMiss);
    add("false_hit", hits.falseHit);
    if (variant.name() == kDefaultPreset || settings.trace.bounces > 1)
      point["error_of_bounces"] =
          pictureErrors(layers, picture, truth_.of(scene, SelectMode::reflective, kMostBounces));
  }

 private:
  const OutputFolder* folder_;
  Workbench* bench_;
  Truth truth_;
};

Task taskOf(const Setup& setup, const BenchScene& scene, const Variant& variant, int round,
            const std::shared_ptr<Measurement>& measurement) {
  const bool quick = setup.request.quick;
  const std::size_t triangles = scene.model.scene.triangles.size();
  const Settings settings = settingsOf(variant, quick, triangles);
  Task task;
  task.series = scene.name + ", " + variant.name();
  task.label = task.series + ", round " + std::to_string(round + 1);
  task.key = pointKey(setup.bench.describe(scene, settings), scene);
  task.key["preset"] = variant.name();
  task.key["family"] = variant.family;
  task.key["knob"] = variant.knob;
  task.key["beside"] = variant.beside;
  task.key["round"] = round;
  task.work = workOf(methodInfo(settings.trace.method).fixedResolution ? 12 : 2, triangles);
  task.measure = [measurement, &scene, variant, settings, round](Json& point) {
    measurement->measure(scene, variant, settings, round, point);
  };
  // The others are compared with the default in the same round: it is there in all of them.
  if (variant.name() != kDefaultPreset)
    task.ends = [quick, round](const Json& point) {
      return round + 1 >= roundsFor(point["time_ms"]["frame"]["median"].get<double>(), quick);
    };
  return task;
}

// Rounds go over all variants of a scene in turn, so that a slow moment of the machine does not fall on one alone.
Plan planPareto(const Setup& setup) {
  if (!exactFactory(setup.scenes.front().model.scene, 0))
    throw Error(ErrorKind::failed, "pareto needs the reference: build with Embree");
  const auto measurement = std::make_shared<Measurement>(setup.folder, setup.bench);
  const bool quick = setup.request.quick;
  Plan plan;
  for (const BenchScene& scene : setup.scenes)
    for (int round = 0; round < roundsFor(0, quick); ++round)
      for (const Variant& variant : variants(quick, scene.model.scene.triangles.size()))
        plan.tasks.push_back(taskOf(setup, scene, variant, round, measurement));
  plan.report = [&folder = setup.folder, &scenes = setup.scenes](const PointList& points) {
    const std::vector<ParetoScene> measured = paretoScenes(points);
    PointList firsts;
    for (const ParetoScene& scene : measured)
      for (const ParetoPoint& point : scene.points) firsts.push_back(point.measured);
    const ChartFiles chart = drawChart(paretoChart(measured));
    return Report{.title = "Speed against accuracy",
                  .tables = {{"pareto", paretoCsv(measured)}},
                  .chart = chart,
                  .body = paretoBody(measured, readPictures(folder, scenes), chart.svg),
                  .summary = paretoSummary(measured),
                  .warnings = lostFragments(firsts)};
  };
  return plan;
}

}  // namespace

int roundsFor(double frameMilliseconds, bool quick) {
  if (quick) return kFewestRounds;
  if (frameMilliseconds * kMostRounds <= kMeasuredMilliseconds) return kMostRounds;
  return std::max(kFewestRounds, static_cast<int>(kMeasuredMilliseconds / frameMilliseconds));
}

CommonRays compareCommonRays(Image image, Image reference, double diagonal) {
  if (image.channel("selected.Y") < 0 || reference.channel("selected.Y") < 0)
    throw Error(ErrorKind::badInput, "no layers to compare");
  const auto mine = static_cast<std::size_t>(image.channel("selected.Y"));
  const auto other = static_cast<std::size_t>(reference.channel("selected.Y"));
  const std::size_t stride = image.channels.size(), otherStride = reference.channels.size();
  std::uint64_t asked = 0;
  for (std::size_t p = 0; p < std::min(image.pixelCount(), reference.pixelCount()); ++p) {
    float &a = image.data[p * stride + mine], &b = reference.data[p * otherStride + other];
    asked += b > 0.5f;
    a = b = std::min(a, b);
  }
  const LayerComparison compared = compareLayers(image, reference, diagonal);
  CommonRays result;
  result.rays = compared.pixels;
  if (compared.pixels == 0) return result;
  result.share = static_cast<double>(compared.pixels) / static_cast<double>(asked);
  result.hitError = compared.hitError;
  result.falseMiss = compared.falseMiss;
  result.falseHit = compared.falseHit;
  return result;
}

Mode paretoMode() {
  return {.name = "pareto", .description = "Speed against accuracy, all methods over their knobs", .plan = planPareto};
}

}  // namespace halfsilver::bench
