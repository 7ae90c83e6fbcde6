#include "bench/harness/bench_scene.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <optional>
#include <set>
#include <utility>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include <halfsilver/methods.h>
#include "apps/scene_input.h"

namespace halfsilver::bench {
namespace {

constexpr std::size_t kLargeScene = 150000;  // triangles; the papers' large scene, Sponza, has 262,000
// Texels along each side for those: with 1280 Sponza's fragments do not fit the texel buffers of all devices.
constexpr int kLargeTexels = 1024;

// The text of --mirror for one scene, without the scene's name before the material; nothing if it is not meant for it.
// In a command of one scene it always is, whatever materials there are.
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
  // Only now: if a later scene is bad, stderr holds the one line that says so.
  for (const std::string& warning : warnings) std::cerr << "warning: " << warning << '\n';
  return scenes;
}

Settings presetSettings(const std::string& preset, bool quick, std::size_t triangles) {
  Settings settings;
  applyPreset(settings, preset);
  if (!methodInfo(settings.trace.method).fixedResolution) return settings;
  settings.voxels.resolution = quick ? 32 : triangles > kLargeScene ? 256 : 64;
  if (quick) settings.abuffer.resolution = 256;
  if (triangles > kLargeScene) settings.abuffer.resolution = std::min(settings.abuffer.resolution, kLargeTexels);
  return settings;
}

}  // namespace halfsilver::bench
