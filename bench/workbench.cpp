#include "bench/workbench.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <set>
#include <utility>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include <halfsilver/methods.h>
#include "apps/drawing.h"

namespace halfsilver::bench {
namespace {

constexpr int kThumbnail = 480;              // pixels
constexpr std::size_t kLargeScene = 150000;  // triangles; the papers' large one is Sponza with 262,000

// The text of --mirror for one scene, without the scene's name before the material; nothing where it is not for it.
// Where it can be for no other scene it is for this one, whatever materials there are.
std::optional<std::string> mirrorFor(const std::string& name, const Scene& scene, const std::string& text,
                                     bool onlyScene) {
  if (text.starts_with(name + ':')) return text.substr(name.size() + 1);
  const std::string material = parseMirror(text).material;
  const bool has = std::any_of(scene.materials.begin(), scene.materials.end(),
                               [&](const Material& m) { return material == "*" || m.name == material; });
  if (has || onlyScene) return text;
  return std::nullopt;
}

CameraRequest cameraFor(const std::string& name, const Request& request) {
  for (const ViewArgument& view : request.views)
    if (view.scene == name) return {"", view.eye, view.target, view.fov};
  return request.camera;
}

}  // namespace

std::vector<BenchScene> loadScenes(const Request& request) {
  std::vector<BenchScene> scenes;
  std::vector<std::string> warnings;
  std::set<std::string> usedMirrors;
  for (const std::string& file : request.scenes) {
    const std::string name = sceneName(file);
    Model model = loadScene(file);
    std::vector<std::string> mirrors;
    for (const std::string& text : request.mirrors)
      if (const auto mirror = mirrorFor(name, model.scene, text, request.scenes.size() == 1)) {
        mirrors.push_back(*mirror);
        applyMirrors(model.scene, std::array{parseMirror(*mirror)});
        usedMirrors.insert(text);
      }
    const Camera camera = chooseCamera(model.scene, cameraFor(name, request));
    const double diagonal = model.scene.bounds().diagonal();
    for (const std::string& warning : model.warnings) warnings.push_back(name + ": " + warning);
    scenes.push_back({name, std::move(model), camera, std::move(mirrors), diagonal});
  }
  for (const std::string& text : request.mirrors)
    if (!scenes.empty() && !usedMirrors.contains(text))
      throw Error(ErrorKind::usage, "--mirror: no scene has a material '" + parseMirror(text).material + "'");
  // Only now: where a later scene is bad, stderr holds the one line that says so.
  for (const std::string& warning : warnings) std::cerr << "warning: " << warning << '\n';
  return scenes;
}

Settings presetSettings(const std::string& preset, bool quick, std::size_t triangles) {
  Settings settings;
  applyPreset(settings, preset);
  if (!methodInfo(settings.trace.method).fixedResolution) return settings;
  settings.voxels.resolution = quick ? 32 : triangles > kLargeScene ? 256 : 64;
  settings.abuffer.resolution = quick ? 256 : 1024;
  return settings;
}

Workbench::Workbench(const Request& request)
    : size_(request.size),
      targetSize_(request.size),
      context_(makeContext(contextKind(request.context))),
      api_(gl::Api::load(context_.getProcAddress())),
      log_(api_),
      target_(api_, size_),
      device_(Renderer(context_.getProcAddress()).device()) {}

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
    // A pool that was sized by a first guess gets the size that the frame before asked for.
    drawNext(scene, run);
    times.add(run.report.times);
  }
  run.stages = times.summarize();
  for (const StageSummary& stage : run.stages)
    if (stage.stage == "frame" && stage.runs == 0) throw Error(ErrorKind::failed, "the device's timer gave no answer");
}

void Workbench::load(const BenchScene& scene) {
  if (scene_ == &scene) return;
  forget();  // its memory goes before the new one's comes
  renderer_.emplace(context_.getProcAddress(), exactFactory(scene.model.scene, 0));
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

void Workbench::drawNext(const BenchScene& scene, RunStatistics& run) {
  renderer_->render(scene.camera, run.settings, target_.target());
  run.report = renderer_->report();
  run.warnings = run.report.warnings;
  failOnErrors();
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
