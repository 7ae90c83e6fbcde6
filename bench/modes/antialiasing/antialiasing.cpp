#include "bench/modes/antialiasing/antialiasing.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "bench/harness/flicker.h"
#include "bench/modes/antialiasing/report.h"

namespace halfsilver::bench {
namespace {

// Of the pan. A history holds 16 frames.
constexpr int kFramesBefore = 24, kFrames = 12, kQuickFrames = 3;
constexpr glm::vec2 kPanPerFrame(0.25f, 0.125f);  // pixels; along no axis of the picture
constexpr int kSamples = 64, kQuickSamples = 16;

// Turned by so many pixels to the right and up.
Camera panned(Camera camera, const glm::vec2& pixels, int height) {
  const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up));
  const glm::vec2 turn = pixels * 2.0f * std::tan(0.5f * camera.verticalFov) / static_cast<float>(height);
  camera.target = camera.eye + forward + turn.x * right + turn.y * glm::cross(right, forward);
  return camera;
}

// A picture's colors, clipped to what a display shows.
std::vector<float> shownColors(const Image& layers) {
  std::vector<float> colors;
  for (const char* name : {"R", "G", "B"})
    for (std::size_t i = static_cast<std::size_t>(layers.channel(name)); i < layers.data.size();
         i += layers.channels.size())
      colors.push_back(std::clamp(layers.data[i], 0.0f, 1.0f));
  return colors;
}

double meanSquaredError(const Image& frame, const Image& truth) {
  const std::vector<float> a = shownColors(frame), b = shownColors(truth);
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0, std::plus<>(),
                            [](double x, double y) { return (x - y) * (x - y); }) /
         static_cast<double>(a.size());
}

// Measures scene by scene; the truth is kept until the next one.
class Measurement {
 public:
  Measurement(bool quick, const OutputFolder& folder, Workbench& bench)
      : quick_(quick), folder_(&folder), bench_(&bench) {}

  AntialiasingKey key(const BenchScene& scene, const Settings& settings, const std::string& name) const {
    return {pointKey(bench_->describe(scene, settings), scene, name), kFramesBefore, frames(), samples()};
  }

  // Frames that are drawn for a point, and its part of the truth.
  int framesOfPoint() const { return kFramesBefore + (1 + frames()) * (1 + samples() / 2); }

  AntialiasingResult measure(BenchScene& scene, const Settings& settings, const std::string& name) {
    const std::vector<Image>& truth = truthOf(scene, settings);
    FlickerMeter all(FlickerMeter::Pixels::all), traced;
    double error = 0;
    RunStatistics run = bench_->describe(scene, settings);
    const Camera still = scene.camera;
    for (int frame = -kFramesBefore; frame <= frames(); ++frame) {
      scene.camera = panned(still, static_cast<float>(frame) * kPanPerFrame, run.height);
      bench_->drawNext(scene, run);
      if (frame < 0) continue;
      const Image layers = bench_->layers();
      const Image& reference = truth[static_cast<std::size_t>(frame)];
      all.add(layers, reference);
      traced.add(layers, reference);
      error += meanSquaredError(layers, reference) / (1 + frames());
    }
    savePicture(*folder_, pictureName(scene.name, name), *bench_);
    scene.camera = still;
    const Flicker ofAll = all.result(), ofTraced = traced.result();
    return {ofAll.mean, ofAll.percentile99, ofTraced.mean, ofTraced.percentile99, std::sqrt(error)};
  }

 private:
  int frames() const { return quick_ ? kQuickFrames : kFrames; }
  int samples() const { return quick_ ? kQuickSamples : kSamples; }

  const std::vector<Image>& truthOf(BenchScene& scene, const Settings& settings) {
    if (truthScene_ == &scene) return truth_;
    truth_.clear();
    RunStatistics run = bench_->describe(scene, settings);
    bench_->draw(scene, run);  // its structure finds its size
    const Camera still = scene.camera;
    for (int frame = 0; frame <= frames(); ++frame) {
      scene.camera = panned(still, static_cast<float>(frame) * kPanPerFrame, run.height);
      bench_->drawSamples(scene, run, samples());
      truth_.push_back(bench_->layers());
    }
    savePicture(*folder_, pictureName(scene.name, kTruth), *bench_);
    scene.camera = still;
    truthScene_ = &scene;
    return truth_;
  }

  bool quick_;
  const OutputFolder* folder_;
  Workbench* bench_;
  const BenchScene* truthScene_ = nullptr;
  std::vector<Image> truth_;  // one per frame that counts
};

Plan planAntialiasing(const Setup& setup) {
  const auto measurement = std::make_shared<Measurement>(setup.request.quick, setup.folder, setup.bench);
  std::vector<Task<AntialiasingPoint>> tasks;
  for (BenchScene& scene : setup.scenes)
    for (const auto& [name, antialiasing] :
         {std::pair(kNone, Antialiasing::none), {kTemporal, Antialiasing::temporal}}) {
      Settings settings;
      applyPreset(settings, kDefaultPreset);
      settings.image.antialiasing = antialiasing;
      tasks.push_back({.key = measurement->key(scene, settings, name),
                       .label = scene.name + ", " + name,
                       .work = workOf(measurement->framesOfPoint(), scene.model.scene.triangles.size()),
                       .measure = [measurement, &scene, settings, name = std::string(name)] {
                         return measurement->measure(scene, settings, name);
                       }});
    }
  const auto report = [&folder = setup.folder](const std::vector<AntialiasingPoint>& points) {
    std::map<std::string, std::string> pictures;
    for (const AntialiasingPoint& point : points)
      for (const std::string& kind : {point.preset, std::string(kTruth)}) {
        const std::string name = pictureName(point.scene.file, kind);
        pictures[name] = readPicture(folder, name);
      }
    return Report{.title = "How smooth pictures are in motion",
                  .tables = {{"antialiasing", antialiasingCsv(points)}},
                  .chart = std::nullopt,
                  .body = antialiasingBody(points, pictures),
                  .summary = antialiasingTable(points)};
  };
  return makePlan<AntialiasingPoint>(std::move(tasks), report);
}

}  // namespace

Mode antialiasingMode() {
  return {.name = "antialiasing",
          .description = "How much pictures flicker in motion, with and without antialiasing",
          .plan = planAntialiasing};
}

}  // namespace halfsilver::bench
