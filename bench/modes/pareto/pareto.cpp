#include "bench/modes/pareto/pareto.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include <halfsilver/methods.h>
#include "apps/drawing.h"
#include "bench/harness/truth.h"
#include "bench/modes/pareto/report.h"
#include "bench/modes/pareto/variants.h"
#include "bench/report/text.h"

namespace halfsilver::bench {
namespace {

constexpr int kMinRounds = 2, kMaxRounds = 5;
constexpr double kMeasuredMilliseconds = 1000 * kParetoSeconds;
constexpr int kMaxBounces = 4;

PictureErrors pictureErrors(const Image& layers, const Image& picture, const Truth::Frame& truth) {
  PictureErrors errors{compareImages({picture, false, {}}, {truth.picture, false, {}}).rmse, {}};
  if (const auto perceptual = comparePerceptually(layers, truth.layers)) errors.perceptible = perceptual->fraction;
  return errors;
}

class Measurement {
 public:
  Measurement(const OutputFolder& folder, Workbench& bench) : folder_(&folder), bench_(&bench), truth_(bench) {}

  ParetoResult measure(const BenchScene& scene, const Variant& variant, const Settings& settings, int round) {
    RunStatistics run = bench_->describe(scene, settings);
    bench_->draw(scene, run);
    ParetoResult result{timedFrame(run), {}, {}};
    if (round > 0) return result;  // every frame is the same to the bit
    if (variant.name() == kDefaultPreset) savePicture(*folder_, scene.name, *bench_);
    const Image layers = bench_->layers(), picture = bench_->picture();
    const Truth::Frame& truth = truth_.of(scene, SelectMode::reflective, settings.trace.bounces);
    result.errors = {pictureErrors(layers, picture, truth), compareCommonRays(layers, truth.layers, scene.diagonal)};
    if (variant.name() == kDefaultPreset || settings.trace.bounces > 1)
      result.errorsOfBounces = pictureErrors(layers, picture, truth_.of(scene, SelectMode::reflective, kMaxBounces));
    return result;
  }

 private:
  const OutputFolder* folder_;
  Workbench* bench_;
  Truth truth_;
};

Task<ParetoPoint> taskOf(const Setup& setup, const BenchScene& scene, const Variant& variant, int round,
                         const std::shared_ptr<Measurement>& measurement) {
  const bool quick = setup.request.quick;
  const std::size_t triangles = scene.model.scene.triangles.size();
  const Settings settings = settingsOf(variant, quick, triangles);
  Task<ParetoPoint> task;
  task.series = scene.name + ", " + variant.name();
  task.label = task.series + ", round " + std::to_string(round + 1);
  task.key = {pointKey(setup.bench.describe(scene, settings), scene, variant.name()), variant.family, variant.knob,
              variant.beside, round};
  task.work = workOf(methodInfo(settings.trace.method).fixedResolution ? 12 : 2, triangles);
  task.measure = [measurement, &scene, variant, settings, round] {
    return measurement->measure(scene, variant, settings, round);
  };
  // The default takes part in all rounds: the others are compared with it in the same round.
  if (variant.name() != kDefaultPreset)
    task.ends = [quick, round](const ParetoPoint& point) {
      return round + 1 >= roundsFor(point.times.frame.median, quick);
    };
  return task;
}

// Each round covers all variants of a scene, so that a slow moment of the machine does not affect only one of them.
Plan planPareto(const Setup& setup) {
  if (!exactFactory(setup.scenes.front().model.scene, 0))
    throw Error(ErrorKind::failed, "pareto needs the reference: build the project with Embree");
  const auto measurement = std::make_shared<Measurement>(setup.folder, setup.bench);
  const bool quick = setup.request.quick;
  std::vector<Task<ParetoPoint>> tasks;
  for (const BenchScene& scene : setup.scenes)
    for (int round = 0; round < roundsFor(0, quick); ++round)
      for (const Variant& variant : variants(quick, scene.model.scene.triangles.size()))
        tasks.push_back(taskOf(setup, scene, variant, round, measurement));
  const auto report = [&folder = setup.folder, &scenes = setup.scenes](const std::vector<ParetoPoint>& points) {
    const std::vector<ParetoScene> measured = paretoScenes(points);
    std::vector<ParetoPoint> firsts;
    for (const ParetoScene& scene : measured)
      for (const ParetoVariant& variant : scene.variants) firsts.push_back(variant.first);
    const auto coverage = [](const ParetoPoint& point) {
      return ", " + percent(point.pixels.coverage) + " of the pixels reflect";
    };
    const ChartFiles chart = drawChart(paretoChart(measured));
    return Report{.title = "Speed against accuracy",
                  .tables = {{"pareto", paretoCsv(measured)}},
                  .chart = chart,
                  .body = paretoBody(measured, sceneFigures(folder, scenes, firsts, coverage), chart.svg),
                  .summary = paretoSummary(measured),
                  .warnings = lostFragments(firsts)};
  };
  return makePlan<ParetoPoint>(std::move(tasks), report);
}

}  // namespace

int roundsFor(double frameMilliseconds, bool quick) {
  if (quick) return kMinRounds;
  if (frameMilliseconds * kMaxRounds <= kMeasuredMilliseconds) return kMaxRounds;
  return std::max(kMinRounds, static_cast<int>(kMeasuredMilliseconds / frameMilliseconds));
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
  return {.name = "pareto",
          .description = "Speed against accuracy, each method with a range of settings",
          .plan = planPareto};
}

}  // namespace halfsilver::bench
