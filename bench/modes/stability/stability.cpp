#include "bench/modes/stability/stability.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <halfsilver/builtin.h>
#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include "apps/drawing.h"
#include "bench/harness/flicker.h"
#include "bench/harness/method_presets.h"
#include "bench/modes/stability/motion.h"
#include "bench/modes/stability/report.h"

namespace halfsilver::bench {
namespace {

constexpr int kFrames = 12, kQuickFrames = 3;
constexpr int kRepeats = 20, kQuickRepeats = 2;
constexpr float kDefaultStep = 5e-4f;  // of the scene's diagonal, for scenes without a motion of their own

struct Variant {
  std::string name;
  Settings settings;
};

// All methods, and Kastrati's with the most careful of its searches.
std::vector<Variant> variants(bool quick) {
  std::vector<Variant> all;
  for (const std::string& preset : methodPresets(quick, 0, false)) {
    const ReflectivePreset reflective = reflectivePreset(preset, quick, 0);
    all.push_back({reflective.name, reflective.settings});
    if (preset != "kastrati2017") continue;
    all.push_back({"kastrati2017 full", reflective.settings});
    all.back().settings.voxels.raster = VoxelRaster::abuffer;
    all.back().settings.attributes.steps = 0;
  }
  return all;
}

struct Subject {
  std::string cause;  // empty unless it is a failure scene
  SlowMove move;
  int bounces = 1;
};

Subject subjectOf(const BenchScene& scene) {
  for (const FailureScene& failure : failureScenes()) {
    std::string name("builtin:");
    name += failure.name;
    if (scene.name == name) return {std::string(failure.cause), failure.move, failure.bounces};
  }
  return {"", {glm::vec3(kDefaultStep * static_cast<float>(scene.diagonal), 0, 0), {}, 1}, 1};
}

// Measures the methods scene by scene; the frames of the reference are kept until the next scene.
class Measurement {
 public:
  Measurement(bool quick, const OutputFolder& folder, Workbench& bench)
      : quick_(quick), folder_(&folder), bench_(&bench) {}

  StabilityKey key(const BenchScene& scene, const Variant& variant) const {
    return {pointKey(bench_->describe(scene, variant.settings), scene, variant.name), frames()};
  }

  // Frames that are drawn for a point.
  int framesOfPoint() const { return frames() + repeats(); }

  StabilityResult measure(BenchScene& scene, const Subject& subject, const Variant& variant) {
    const std::vector<Image>& exact = truth(scene, subject);
    RunStatistics run = bench_->describe(scene, variant.settings);
    FlickerMeter meter;
    StabilityResult result;
    result.cause = subject.cause;
    result.repeatsExactly = true;
    animate(scene, subject, run, [&](int frame) {
      const Image layers = bench_->layers();
      const Image& reference = exact[static_cast<std::size_t>(frame)];
      const auto errors = compareImages({layers, true, scene.diagonal}, {reference, true, scene.diagonal}).layers;
      if (!errors) throw Error(ErrorKind::failed, "no layers to compare");
      if (frame == 0) {
        result.rays = errors->pixels;
        result.hitError = errors->hitError;
        result.falseMiss = errors->falseMiss;
        savePicture(*folder_, pictureName(scene.name, variant.name), *bench_);
        for (int i = 1; i < repeats(); ++i) {
          bench_->drawNext(scene, run);
          result.repeatsExactly = result.repeatsExactly && bench_->layers().data == layers.data;
        }
      }
      result.worstHitError = std::max(result.worstHitError, errors->hitError);
      result.overflow = std::max(result.overflow, errors->overflow);
      result.lostFragments = std::max(result.lostFragments, run.report.lostFragments);
      meter.add(layers, reference);
    });
    const Flicker flicker = meter.result();
    result.flickerMean = flicker.mean;
    result.flicker99 = flicker.percentile99;
    result.flickerHits = flicker.hits;
    result.quietSteps = flicker.identical;
    result.steps = flicker.steps;
    return result;
  }

 private:
  int frames() const { return quick_ ? kQuickFrames : kFrames; }
  int repeats() const { return quick_ ? kQuickRepeats : kRepeats; }

  // Calls `use(frame)` after each frame of the motion. Each is drawn once, so that a pool that is too small shows.
  template <class Use>
  void animate(BenchScene& scene, const Subject& subject, RunStatistics& run, Use&& use) {
    Motion motion(scene, subject.move);
    for (int frame = 0; frame <= frames(); ++frame) {
      const std::vector<VertexRange> moved = motion.to(frame);
      if (frame == 0) {
        bench_->draw(scene, run);
      } else {
        bench_->moveVertices(scene, moved);
        bench_->drawNext(scene, run);
      }
      use(frame);
    }
    bench_->moveVertices(scene, motion.to(0));
  }

  const std::vector<Image>& truth(BenchScene& scene, const Subject& subject) {
    if (truthScene_ == &scene) return truth_;
    truth_.clear();
    Settings settings;
    applyPreset(settings, kReference);
    settings.trace.bounces = subject.bounces;
    RunStatistics run = bench_->describe(scene, settings);
    animate(scene, subject, run, [&](int frame) {
      truth_.push_back(bench_->layers());
      if (frame == 0) savePicture(*folder_, pictureName(scene.name, kReference), *bench_);
    });
    truthScene_ = &scene;
    return truth_;
  }

  bool quick_;
  const OutputFolder* folder_;
  Workbench* bench_;
  const BenchScene* truthScene_ = nullptr;
  std::vector<Image> truth_;  // one per frame
};

std::map<std::string, std::string> readPictures(const OutputFolder& folder, StabilityPoints points) {
  std::map<std::string, std::string> pictures;
  for (const StabilityPoint& point : points)
    for (const std::string& method : {point.preset, std::string(kReference)}) {
      const std::string name = pictureName(point.scene.file, method);
      pictures[name] = readPicture(folder, name);
    }
  return pictures;
}

// The methods that were asked for.
std::vector<Variant> chosenVariants(const Request& request) {
  std::vector<Variant> all = variants(request.quick);
  if (request.methods.empty()) return all;
  std::vector<Variant> chosen;
  for (const std::string& name : request.methods) {
    const auto known =
        std::find_if(all.begin(), all.end(), [&](const Variant& variant) { return variant.name == name; });
    if (known == all.end()) throw Error(ErrorKind::usage, "--method " + name + ": there is no such method");
    chosen.push_back(*known);
  }
  return chosen;
}

Request withFailureScenes(Request request) {
  for (const FailureScene& failure : failureScenes()) {
    std::string name("builtin:");
    name += failure.name;
    request.scenes.push_back(std::move(name));
  }
  return request;
}

Plan planStability(const Setup& setup) {
  const std::vector<Variant> methods = chosenVariants(setup.request);
  const auto failures = std::make_shared<std::vector<BenchScene>>();
  if (setup.scenes.empty()) *failures = loadScenes(withFailureScenes(setup.request));
  std::vector<BenchScene>& scenes = setup.scenes.empty() ? *failures : setup.scenes;
  if (!exactFactory(scenes.front().model.scene, 0))
    throw Error(ErrorKind::failed, "stability needs the reference: build the project with Embree");
  const auto measurement = std::make_shared<Measurement>(setup.request.quick, setup.folder, setup.bench);
  std::vector<Task<StabilityPoint>> tasks;
  for (BenchScene& scene : scenes) {
    const Subject subject = subjectOf(scene);
    for (Variant variant : methods) {
      variant.settings.trace.bounces = subject.bounces;
      tasks.push_back({.key = measurement->key(scene, variant),
                       .label = scene.name + ", " + variant.name,
                       .work = workOf(measurement->framesOfPoint(), scene.model.scene.triangles.size()),
                       .measure = [measurement, failures, &scene, subject, variant] {
                         return measurement->measure(scene, subject, variant);
                       }});
    }
  }
  const auto report = [&folder = setup.folder](const std::vector<StabilityPoint>& points) {
    return Report{.title = "Where methods fail",
                  .tables = {{"stability", stabilityCsv(points)}},
                  .chart = std::nullopt,
                  .body = stabilityBody(points, readPictures(folder, points)),
                  .summary = stabilityTable(points)};
  };
  return makePlan<StabilityPoint>(std::move(tasks), report);
}

}  // namespace

Mode stabilityMode() {
  return {.name = "stability",
          .description = "Where each method fails, still and in motion",
          .takesMethods = true,
          .bringsOwnScenes = true,
          .plan = planStability};
}

}  // namespace halfsilver::bench
