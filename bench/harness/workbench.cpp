#include "bench/harness/workbench.h"

#include <algorithm>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include <halfsilver/methods.h>
#include "apps/drawing.h"

namespace halfsilver::bench {
namespace {

constexpr int kThumbnail = 480;  // pixels

}  // namespace

Workbench::Workbench(const Request& request)
    : size_(request.size),
      targetSize_(request.size),
      context_(makeContext(contextKind(request.context))),
      watch_(context_.getProcAddress()),
      api_(gl::Api::load(context_.getProcAddress())),
      log_(api_),
      target_(api_, size_),
      device_(Renderer(context_.getProcAddress()).device()) {
  keepFreedMemory();
}

RunStatistics Workbench::describe(const BenchScene& scene, const Settings& settings) const {
  RunStatistics run;
  run.device = device_;
  run.context = context_.name();
  run.sceneFile = scene.name;
  run.triangles = scene.model.scene.triangles.size();
  run.vertices = scene.model.scene.vertices.size();
  run.materials = scene.model.scene.materials.size();
  run.textures = scene.model.scene.textures.size();
  run.lights = scene.model.scene.lights.size();
  run.diagonal = scene.diagonal;
  run.settings = settings;
  run.width = size_.width;
  run.height = size_.height;
  return run;
}

void Workbench::draw(const BenchScene& scene, RunStatistics& run, int frames) {
  if (targetSize_.width != run.width || targetSize_.height != run.height) {
    const Size size{run.width, run.height};
    target_ = OffscreenTarget(api_, size);
    targetSize_ = size;
  }
  load(scene);
  run.warmUpFrames = drawFirstFrame(*renderer_, scene.camera, run.settings, target_.target(), run.report);
  StageTimes times;
  for (int frame = 0; frame < frames; ++frame) {
    // A pool whose size was a first guess grows to what the previous frame asked for.
    drawNext(scene, run);
    times.add(run.report.times);
  }
  run.stages = times.summarize();
  for (const StageSummary& stage : run.stages)
    if (stage.stage == "frame" && stage.runs == 0)
      throw Error(ErrorKind::failed, "the device's timer returned no result");
}

void Workbench::load(const BenchScene& scene) {
  if (scene_ == &scene) return;
  forget();  // frees its memory before the new one needs memory
  renderer_.emplace(watch_.getProcAddress(), exactFactory(scene.model.scene, 0));
  renderer_->setScene(scene.model.scene);
  scene_ = &scene;
}

void Workbench::forget() {
  renderer_.reset();
  scene_ = nullptr;
  log_.take();
  while (api_.GetError() != GL_NO_ERROR) {
  }
}

std::vector<RayWork> Workbench::rayWork() {
  try {
    return renderer_->readRayWork();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::usage) throw;
    return {};
  }
}

void Workbench::drawNext(const BenchScene& scene, RunStatistics& run) {
  watch_.take();
  renderer_->render(scene.camera, run.settings, target_.target());
  work_ = watch_.take();
  run.report = renderer_->report();
  run.warnings = run.report.warnings;
  failOnErrors();
}

void Workbench::drawSamples(const BenchScene& scene, RunStatistics& run, int samples) {
  run.report = drawPicture(*renderer_, scene.camera, run.settings, target_.target(), samples);
  run.warnings = run.report.warnings;
  failOnErrors();
}

void Workbench::startOver(const BenchScene& scene) {
  renderer_->forgetStructures();
  renderer_->update(scene.model.scene, {.lights = true});
}

void Workbench::moveVertices(const BenchScene& scene, std::span<const VertexRange> ranges) {
  renderer_->updateVertices(scene.model.scene, ranges);
}

Image Workbench::picture() const {
  const std::vector<std::uint8_t> pixels = target_.read();
  Image image{targetSize_.width, targetSize_.height, {"R", "G", "B"}, {}};
  image.data.reserve(image.pixelCount() * 3);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    if (i % 4 != 3) image.data.push_back(static_cast<float>(pixels[i]) / 255.0f);
  return image;
}

std::vector<std::byte> Workbench::thumbnail() const {
  const std::vector<std::uint8_t> pixels = target_.read();
  const int step = (std::max(targetSize_.width, targetSize_.height) + kThumbnail - 1) / kThumbnail;
  const int width = std::max(1, targetSize_.width / step), height = std::max(1, targetSize_.height / step);
  std::vector<std::uint8_t> small;
  small.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
  const auto average = [&](int left, int top, int channel) {
    int sum = 0, count = 0;
    for (int y = top; y < std::min(top + step, targetSize_.height); ++y)
      for (int x = left; x < std::min(left + step, targetSize_.width); ++x, ++count)
        sum += pixels[(static_cast<std::size_t>(y) * static_cast<std::size_t>(targetSize_.width) +
                       static_cast<std::size_t>(x)) *
                          4 +
                      static_cast<std::size_t>(channel)];
    return static_cast<std::uint8_t>(sum / count);
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int channel = 0; channel < 4; ++channel) small.push_back(average(x * step, y * step, channel));
  return encodePng(width, height, small);
}

void Workbench::failOnErrors() {
  for (const gl::DebugMessage& message : log_.take())
    if (message.error()) throw Error(ErrorKind::failed, "GL error: " + message.text);
  // Not every driver reports every error to the callback.
  if (const GLenum code = api_.GetError(); code != GL_NO_ERROR)
    throw Error(ErrorKind::failed, "GL error " + std::to_string(code));
}

}  // namespace halfsilver::bench
