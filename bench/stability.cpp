#include "bench/stability.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>

#include <halfsilver/builtin.h>
#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include "apps/drawing.h"
#include "bench/flicker.h"
#include "bench/points.h"
#include "bench/report.h"
#include "bench/stability_report.h"
#include "bench/tasks.h"
#include "bench/workbench.h"
#include "io/atomic_file.h"

namespace halfsilver::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFrames = 12, kQuickFrames = 3;
constexpr int kRepeats = 20, kQuickRepeats = 2;
constexpr float kDefaultStep = 5e-4f;  // of the scene's diagonal, for scenes without a move of their own
constexpr const char* kMoving = "moving";

struct Variant {
  std::string name;
  Settings settings;
};

std::vector<Variant> variants(bool quick) {
  const auto paper = [&](const char* preset) {
    Settings settings;
    applyPreset(settings, preset);
    settings.select.mode = SelectMode::reflective;
    if (quick) settings.voxels.resolution = 32;
    if (quick) settings.abuffer.resolution = 256;
    return settings;
  };
  std::vector<Variant> all(1);
  applyPreset(all[0].settings, all[0].name = "halfsilver");
  all.push_back({"kastrati2017", paper("kastrati2017")});
  Settings full = paper("kastrati2017");
  full.voxels.raster = VoxelRaster::abuffer;
  full.attributes.steps = 0;
  all.push_back({"kastrati2017 full", full});
  all.push_back({"hu2014 reflective", paper("hu2014")});
  return all;
}

struct Subject {
  std::string cause;  // empty for scenes that are no failure scenes
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

// A scene on its way: what moves is known by its material.
class Motion {
 public:
  Motion(BenchScene& scene, const SlowMove& move) : scene_(&scene), move_(move), eye_(scene.camera.eye) {
    const std::vector<Material>& materials = scene.model.scene.materials;
    std::uint32_t first = ~0u, last = 0;
    for (const Triangle& triangle : scene.model.scene.triangles)
      for (const std::uint32_t vertex : triangle.vertices)
        if (materials[triangle.material].name == kMoving) {
          first = std::min(first, vertex);
          last = std::max(last, vertex);
        }
    if (first <= last) range_ = {first, last - first + 1};
    const auto begin = scene.model.scene.vertices.begin() + (range_.count > 0 ? range_.first : 0);
    rest_.assign(begin, begin + range_.count);
    for (const Vertex& vertex : rest_) middle_ += vertex.position / static_cast<float>(rest_.size());
  }

  // Frame 0 is the rest. Returns what vertices have changed.
  std::vector<VertexRange> to(int frame) {
    const auto steps = static_cast<float>(frame);
    scene_->camera.eye = eye_ + steps * move_.camera;
    if (range_.count == 0) return {};
    const float size = std::pow(move_.growth, steps);
    for (std::uint32_t i = 0; i < range_.count; ++i)
      scene_->model.scene.vertices[range_.first + i].position =
          middle_ + size * (rest_[i].position - middle_) + steps * move_.object;
    return {range_};
  }

 private:
  BenchScene* scene_;
  SlowMove move_;
  glm::vec3 eye_, middle_{0};
  VertexRange range_;
  std::vector<Vertex> rest_;
};

// Measures the methods scene by scene; the frames of the reference are kept for as long as a scene lasts.
class Measurement {
 public:
  Measurement(bool quick, const OutputFolder& folder, Workbench& bench)
      : quick_(quick), folder_(&folder), bench_(&bench) {}

  Json key(const BenchScene& scene, const Variant& variant) const {
    Json key = pointKey(bench_->describe(scene, variant.settings), scene);
    key["preset"] = variant.name;
    key["frames"] = frames();
    return key;
  }

  // Drawn for a point.
  int framesOfPoint() const { return frames() + (quick_ ? kQuickRepeats : kRepeats); }

  // Adds the measured members to the point.
  void measure(BenchScene& scene, const Subject& subject, const Variant& variant, Json& point) {
    const std::vector<Image>& exact = truth(scene, subject);
    RunStatistics run = bench_->describe(scene, variant.settings);
    FlickerMeter meter;
    LayerComparison still;
    double worst = 0, overflow = 0;
    std::uint64_t lost = 0;
    bool repeats = true;
    animate(scene, subject, run, [&](int frame) {
      const Image layers = bench_->layers();
      const Image& reference = exact[static_cast<std::size_t>(frame)];
      const auto errors = compareImages({layers, true, scene.diagonal}, {reference, true, scene.diagonal}).layers;
      if (!errors) throw Error(ErrorKind::failed, "no layers to compare");
      if (frame == 0) {
        still = *errors;
        keepPicture(*folder_, pictureName(scene.name, variant.name), *bench_);
        for (int i = 1; i < (quick_ ? kQuickRepeats : kRepeats); ++i) {
          bench_->drawNext(scene, run);
          repeats = repeats && bench_->layers().data == layers.data;
        }
      }
      worst = std::max(worst, errors->hitError);
      overflow = std::max(overflow, errors->overflow);
      lost = std::max(lost, run.report.lostFragments);
      meter.add(layers, reference);
    });
    const Flicker flicker = meter.result();
    point["cause"] = subject.cause;
    point["rays"] = still.pixels;
    point["hit_error"] = still.hitError;
    point["false_miss"] = still.falseMiss;
    point["worst_hit_error"] = worst;
    point["overflow"] = overflow;
    point["lost_fragments"] = lost;
    point["flicker_mean"] = flicker.mean;
    point["flicker_99"] = flicker.percentile99;
    point["flicker_hits"] = flicker.hits;
    point["quiet_steps"] = flicker.identical;
    point["steps"] = flicker.steps;
    point["repeats_to_the_bit"] = repeats;
  }

 private:
  int frames() const { return quick_ ? kQuickFrames : kFrames; }

  // Calls `use(frame)` after each frame of the move has been drawn, each once: a pool that was too small shows.
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
      if (frame == 0) keepPicture(*folder_, pictureName(scene.name, kReference), *bench_);
    });
    truthScene_ = &scene;
    return truth_;
  }

  bool quick_;
  const OutputFolder* folder_;
  Workbench* bench_;
  const BenchScene* truthScene_ = nullptr;
  std::vector<Image> truth_;  // a frame each
};

std::map<std::string, std::string> readPictures(const OutputFolder& folder, const PointList& points) {
  std::map<std::string, std::string> pictures;
  for (const Json& point : points)
    for (const std::string& method : {presetOf(point), std::string(kReference)}) {
      const std::string name = pictureName(sceneOf(point), method);
      pictures[name] = readBytes(folder / pictureFile(name));
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
    throw Error(ErrorKind::failed, "stability needs the reference: build with Embree");
  const auto measurement = std::make_shared<Measurement>(setup.request.quick, setup.folder, setup.bench);
  Plan plan;
  for (BenchScene& scene : scenes) {
    const Subject subject = subjectOf(scene);
    for (Variant variant : methods) {
      variant.settings.trace.bounces = subject.bounces;
      plan.tasks.push_back({measurement->key(scene, variant), scene.name + ", " + variant.name,
                            workOf(measurement->framesOfPoint(), scene.model.scene.triangles.size()),
                            [measurement, failures, &scene, subject, variant](Json& point) {
                              measurement->measure(scene, subject, variant, point);
                            }});
    }
  }
  plan.report = [&folder = setup.folder](const PointList& points) {
    return Report{.title = "Where methods fail",
                  .tables = {{"stability", stabilityCsv(points)}},
                  .chart = std::nullopt,
                  .body = stabilityBody(points, readPictures(folder, points)),
                  .summary = stabilityTable(points)};
  };
  return plan;
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
