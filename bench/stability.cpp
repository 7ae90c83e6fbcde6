#include "bench/stability.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <utility>

#include "apps/drawing.h"
#include "apps/progress.h"
#include "bench/estimate.h"
#include "bench/flicker.h"
#include "bench/points.h"
#include "bench/stability_report.h"
#include "bench/workbench.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/settings_file.h"
#include "scene/failures.h"

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
  full.search.steps = 0;
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

std::string readBytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class Measurement {
 public:
  Measurement(const Request& request, std::vector<BenchScene>& scenes, const OutputFolder& folder, Workbench& bench)
      : quick_(request.quick), folder_(&folder), bench_(&bench), points_(folder / "stability.json", "stability") {
    for (BenchScene& scene : scenes)
      for (const Variant& variant : variants(request.quick)) {
        Task task{&scene, subjectOf(scene), variant, {}, false};
        task.variant.settings.trace.bounces = task.subject.bounces;
        task.key = pointKey(bench.describe(scene, task.variant.settings), scene);
        task.key["preset"] = variant.name;
        task.key["frames"] = frames();
        task.known = points_.find(task.key) != nullptr;
        if (!task.known) estimate_.plan(1);
        tasks_.push_back(std::move(task));
      }
  }

  std::vector<Json> run() {
    Progress progress;
    std::vector<Json> results;
    for (const Task& task : tasks_) {
      if (!task.known) {
        const std::string left = estimate_.left();
        progress.show("point " + std::to_string(results.size() + 1) + " of " + std::to_string(tasks_.size()) + ": " +
                      task.scene->name + ", " + task.variant.name + (left.empty() ? "" : ", " + left));
        const auto start = std::chrono::steady_clock::now();
        measure(task);
        estimate_.done(1, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      }
      results.push_back(*points_.find(task.key));
    }
    return results;
  }

 private:
  struct Task {
    BenchScene* scene;
    Subject subject;
    Variant variant;
    Json key;
    bool known;
  };

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
    applyPreset(settings, "reference");
    settings.trace.bounces = subject.bounces;
    RunStatistics run = bench_->describe(scene, settings);
    animate(scene, subject, run, [&](int frame) {
      truth_.push_back(bench_->layers());
      if (frame == 0) keepPicture(scene.name, "reference");
    });
    truthScene_ = &scene;
    return truth_;
  }

  void measure(const Task& task) {
    BenchScene& scene = *task.scene;
    const std::vector<Image>& exact = truth(scene, task.subject);
    RunStatistics run = bench_->describe(scene, task.variant.settings);
    FlickerMeter meter;
    LayerComparison still;
    double worst = 0, overflow = 0;
    std::uint64_t lost = 0;
    bool repeats = true;
    animate(scene, task.subject, run, [&](int frame) {
      const Image layers = bench_->layers();
      const Image& reference = exact[static_cast<std::size_t>(frame)];
      const auto errors = compareImages({layers, true, scene.diagonal}, {reference, true, scene.diagonal}).layers;
      if (!errors) throw Error(ErrorKind::failed, "no layers to compare");
      if (frame == 0) {
        still = *errors;
        keepPicture(scene.name, task.variant.name);
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
    Json point = task.key;
    point["cause"] = task.subject.cause;
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
    points_.keep(std::move(point));
  }

  void keepPicture(const std::string& scene, const std::string& method) {
    AtomicFile file(*folder_ / pictureName(scene, method));
    file.write(bench_->thumbnail());
    file.commit();
  }

  bool quick_;
  const OutputFolder* folder_;
  Workbench* bench_;
  Points points_;
  Estimate estimate_;
  std::vector<Task> tasks_;
  const BenchScene* truthScene_ = nullptr;
  std::vector<Image> truth_;  // a frame each
};

void writeReport(const OutputFolder& folder, const std::vector<Json>& points) {
  std::map<std::string, std::string> pictures;
  for (const Json& point : points)
    for (const std::string& method : {point["preset"].get<std::string>(), std::string("reference")}) {
      const std::string name = pictureName(point["scene"]["file"].get<std::string>(), method);
      pictures[name] = readBytes(folder / name);
    }
  AtomicFile csv(folder / "stability.csv"), html(folder / "index.html");
  csv.write(toCsv(stabilityCsv(points)));
  html.write(stabilityPage(points, pictures));
  csv.commit();
  html.commit();
}

}  // namespace

void runStability(const Request& request) {
  Request all = request;
  if (all.scenes.empty())
    for (const FailureScene& failure : failureScenes()) {
      std::string name("builtin:");
      name += failure.name;
      all.scenes.push_back(std::move(name));
    }
  std::vector<BenchScene> scenes = loadScenes(all);
  if (!exactFactory(scenes.front().model.scene, 0))
    throw Error(ErrorKind::failed, "stability needs the reference: build with Embree");
  Workbench bench(all);
  const OutputFolder folder(all.folder);
  const std::vector<Json> points = Measurement(all, scenes, folder, bench).run();
  writeReport(folder, points);
  std::cout << toText(stabilityTable(points));
}

}  // namespace halfsilver::bench
