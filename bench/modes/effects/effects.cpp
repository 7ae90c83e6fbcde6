#include "bench/modes/effects/effects.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include "apps/drawing.h"
#include "bench/modes/effects/report.h"

namespace halfsilver::bench {
namespace {

constexpr int kFrames = 3;
constexpr int kSamplesPerPass = 64;
constexpr int kTruthPasses = 16, kQuickTruthPasses = 2;

struct Variant {
  std::string effect;
  std::string preset;
  std::vector<std::pair<std::string, std::string>> values = {};
  std::string samples = {};  // the setting that says how many; empty: nothing is chosen at random
};

// In the order of the page. The default reflects.
std::vector<Variant> variants() {
  return {
      {.effect = "reflection", .preset = kDefaultPreset},
      {.effect = "glossy", .preset = "glossy", .samples = "effect.samples"},
      {.effect = "shadow rays",
       .preset = kDefaultPreset,
       .values = {{"shadow.method", "rays"}},
       .samples = "shadow.samples"},
      {.effect = "whitted", .preset = "whitted"},
      {.effect = "occlusion", .preset = "occlusion", .values = {{"effect.passes", "1"}}, .samples = "effect.samples"},
      {.effect = "path", .preset = "path", .samples = "effect.samples"},
      {.effect = "layers", .preset = "layers"}};
}

Settings settingsOf(const Variant& variant, const std::string& method, int samples) {
  Settings settings;
  applyPreset(settings, variant.preset);
  for (const auto& [name, value] : variant.values) set(settings, name, value);
  if (!variant.samples.empty()) set(settings, variant.samples, std::to_string(samples));
  settings.trace.method = method;
  return settings;
}

double rmseOf(const Image& frame, const Image& truth) {
  double squares = 0;
  for (const char* name : {"R", "G", "B"}) {
    const auto channel = static_cast<std::size_t>(frame.channel(name));
    const auto other = static_cast<std::size_t>(truth.channel(name));
    for (std::size_t pixel = 0; pixel < frame.pixelCount(); ++pixel) {
      const float a = std::clamp(frame.data[pixel * frame.channels.size() + channel], 0.0f, 1.0f);
      const float b = std::clamp(truth.data[pixel * truth.channels.size() + other], 0.0f, 1.0f);
      squares += static_cast<double>((a - b) * (a - b));
    }
  }
  return std::sqrt(squares / (3.0 * static_cast<double>(frame.pixelCount())));
}

std::vector<int> sampleCounts(const Variant& variant, bool quick) {
  if (variant.samples.empty()) return {1};
  if (quick) return {1, 4};
  // Reflections have no passes, so that their truth has no more samples than this.
  if (settingsOf(variant, kExactRays, 1).trace.effect == Effect::reflection) return {1, 4, 16};
  return {1, 4, 16, kSamplesPerPass};
}

// Measures scene by scene and effect by effect; a truth is kept until the next one.
class Measurement {
 public:
  Measurement(bool quick, const OutputFolder& folder, Workbench& bench)
      : quick_(quick), folder_(&folder), bench_(&bench) {}

  int truthSamples(const Variant& variant) const {
    if (variant.samples.empty()) return 1;
    const bool passes = settingsOf(variant, kExactRays, 1).trace.effect != Effect::reflection;
    return kSamplesPerPass * (!passes ? 1 : quick_ ? kQuickTruthPasses : kTruthPasses);
  }

  EffectResult measure(const BenchScene& scene, const Variant& variant, const Settings& settings) {
    const Image& truth = truthOf(scene, variant);
    RunStatistics run = bench_->describe(scene, settings);
    bench_->draw(scene, run, kFrames);
    EffectResult result;
    static_cast<TimedFrame&>(result) = timedFrame(run);
    result.rays = std::accumulate(run.report.rays.begin(), run.report.rays.begin() + kRayKinds, std::uint64_t{0});
    if (result.rays > 0)
      result.microsecondsPerRay = 1000 * result.times.trace.median / static_cast<double>(result.rays);
    result.rmse = rmseOf(bench_->layers(), truth);
    return result;
  }

 private:
  const Image& truthOf(const BenchScene& scene, const Variant& variant) {
    if (truthScene_ == &scene && truthEffect_ == variant.effect) return truth_;
    Settings settings = settingsOf(variant, kExactRays, kSamplesPerPass);
    settings.effect.passes = std::max(1, truthSamples(variant) / kSamplesPerPass);
    RunStatistics run = bench_->describe(scene, settings);
    bench_->draw(scene, run);
    truth_ = bench_->layers();
    savePicture(*folder_, pictureName(scene.name, variant.effect), *bench_);
    truthScene_ = &scene;
    truthEffect_ = variant.effect;
    return truth_;
  }

  bool quick_;
  const OutputFolder* folder_;
  Workbench* bench_;
  const BenchScene* truthScene_ = nullptr;
  std::string truthEffect_;
  Image truth_;
};

Plan planEffects(const Setup& setup) {
  if (!exactFactory(setup.scenes.front().model.scene, 0))
    throw Error(ErrorKind::failed, "effects needs the reference: build the project with Embree");
  const auto measurement = std::make_shared<Measurement>(setup.request.quick, setup.folder, setup.bench);
  std::vector<Task<EffectPoint>> tasks;
  for (BenchScene& scene : setup.scenes)
    for (const Variant& variant : variants())
      for (const int samples : sampleCounts(variant, setup.request.quick))
        for (const char* method : {"identity", kExactRays}) {
          const Settings settings = settingsOf(variant, method, samples);
          std::string name = variant.effect + ", " + method;
          if (!variant.samples.empty()) name += ", " + std::to_string(samples);
          EffectKey key;
          static_cast<PointKey<>&>(key) = pointKey(setup.bench.describe(scene, settings), scene, name);
          key.effect = variant.effect;
          key.method = method;
          key.samples = samples;
          key.truthSamples = measurement->truthSamples(variant);
          tasks.push_back({.key = std::move(key),
                           .label = scene.name + ", " + name,
                           .work = workOf(1 + kFrames, scene.model.scene.triangles.size()),
                           .measure = [measurement, &scene, variant, settings] {
                             return measurement->measure(scene, variant, settings);
                           }});
        }
  const auto report = [&folder = setup.folder](const std::vector<EffectPoint>& points) {
    std::map<std::string, std::string> pictures;
    for (const EffectPoint& point : points) {
      const std::string name = pictureName(point.scene.file, point.effect);
      pictures[name] = readPicture(folder, name);
    }
    const ChartFiles chart = drawChart(effectsChart(points));
    return Report{.title = "What each effect costs",
                  .tables = {{"effects", effectsCsv(points)}},
                  .chart = chart,
                  .body = effectsBody(points, pictures, chart.svg),
                  .summary = effectsTable(points)};
  };
  return makePlan<EffectPoint>(std::move(tasks), report);
}

}  // namespace

Mode effectsMode() {
  return {.name = "effects",
          .description = "Speed against accuracy of each effect: glossy, shadows, Whitted, occlusion, paths, layers",
          .plan = planEffects};
}

}  // namespace halfsilver::bench
