#include "bench/modes/paper/published.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "apps/scene_input.h"

namespace halfsilver::bench {
namespace {

BenchScene sceneOf(const std::string& name, const std::string& file, const CameraRequest& view,
                   const std::vector<std::string>& mirrors) {
  Model model = loadScene(file);
  for (const std::string& mirror : mirrors) applyMirrors(model.scene, std::array{parseMirror(mirror)});
  const Camera camera = chooseCamera(model.scene, view);
  const double diagonal = model.scene.bounds().diagonal();
  return {name, std::move(model), camera, mirrors, diagonal};
}

Light lamp(LightType type, const glm::vec3& position, const glm::vec3& target, float intensity) {
  Light light;
  light.type = type;
  light.position = position;
  light.direction = glm::normalize(target - position);
  light.intensity = intensity;
  return light;
}

// With other lights, which lie around the scene's bounds.
BenchScene litBy(BenchScene scene, std::string name, std::vector<Light> lights) {
  scene.name = std::move(name);
  scene.model.scene.lights = std::move(lights);
  return scene;
}

}  // namespace

const BenchScene& PaperScenes::of(const std::string& name) const {
  const auto found =
      std::find_if(scenes.begin(), scenes.end(), [&](const BenchScene& scene) { return scene.name == name; });
  if (found == scenes.end()) throw std::out_of_range("there is no scene " + name);
  return *found;
}

PaperScenes paperScenes(const std::string& folder, bool quick) {
  PaperScenes result;
  std::vector<BenchScene>& scenes = result.scenes;
  scenes.push_back(sceneOf("sphere", "builtin:sphere", {}, {}));
  scenes.push_back(sceneOf("teapot", "builtin:teapot", {}, {}));
  scenes.push_back(sceneOf("glass", "builtin:glass", {}, {}));
  result.standIns = {
      "sphere, teapot: builtin:sphere and builtin:teapot, with other triangles and surroundings than "
      "the papers' own, which are not published",
      "glass: builtin:glass, a ball and a teapot of glass, for the refracting pictures of Hu et al."};
  const std::filesystem::path sponza = std::filesystem::path(folder) / "sponza.glb";
  if (!folder.empty() && std::filesystem::exists(sponza)) {
    scenes.push_back(sceneOf("Sponza", sponza.string(),
                             {"", glm::vec3(13, 1.2f, 0.4f), glm::vec3(-5, 2.6f, -0.2f), std::nullopt}, {"floor=0.9"}));
    result.standIns.emplace_back("Sponza: sponza.glb, its floor a mirror, in the view of the README");
  } else if (quick) {
    scenes.push_back(sceneOf("Sponza", "builtin:teapot", {}, {}));
    result.standIns.emplace_back("Sponza: in quick runs without sponza.glb builtin:teapot, which is no likeness");
  } else {
    scenes.push_back(sceneOf("Sponza", "builtin:atrium", {}, {}));
    result.standIns.emplace_back("Sponza: builtin:atrium stands for it; --scenes names a folder with sponza.glb");
  }
  for (const auto& [name, otherwise] : {std::pair("bunny", "builtin:teapot"), {"dragon", "builtin:sphere"}}) {
    const std::filesystem::path file = std::filesystem::path(folder) / (std::string(name) + ".glb");
    const bool there = !folder.empty() && std::filesystem::exists(file);
    scenes.push_back(there ? sceneOf(name, file.string(), {}, {"*=0.9"}) : sceneOf(name, otherwise, {}, {}));
    result.standIns.push_back(
        std::string(name) + ": " +
        (there ? std::string(name) + ".glb, all of it a mirror"
               : std::string(otherwise) + " stands for it; --scenes names a folder with " + name + ".glb"));
  }
  // Beck et al. have one directional light.
  for (const char* name : {"sphere", "teapot", "Sponza"}) {
    Light sun = lamp(LightType::directional, glm::vec3(0), glm::vec3(-0.4f, -1, -0.3f), 4);
    scenes.push_back(litBy(result.of(name), std::string(name) + ", one sun", {sun}));
  }
  scenes.push_back(sceneOf("robots", "builtin:game", {}, {}));
  result.standIns.emplace_back(
      "robots: builtin:game, 75 k triangles with walking figures; the torus of Robert et al.: builtin:sphere");
  // Hu et al. name their lights, not where they are.
  const BenchScene& teapot = result.of("teapot");
  const glm::vec3 center = teapot.model.scene.bounds().center(), half = 0.5f * teapot.model.scene.bounds().extent();
  const float reach = glm::length(half);
  const glm::vec3 left = center + glm::vec3(-0.5f, 0.9f, 0.5f) * reach,
                  right = center + glm::vec3(0.6f, 0.8f, 0.3f) * reach;
  BenchScene twoLamps = litBy(teapot, "teapot, two lamps",
                              {lamp(LightType::point, left, center, 6 * reach * reach),
                               lamp(LightType::point, right, center, 4 * reach * reach)});
  Light panel = lamp(LightType::rectangle, left, center, 30);
  panel.width = panel.height = 0.5f * reach;
  BenchScene areaLit = litBy(teapot, "teapot, area light", {panel});
  areaLit.model.scene.sky.intensity = 0.1f;
  BenchScene skyLit = litBy(teapot, "teapot, environment", {});
  for (BenchScene* made : {&twoLamps, &areaLit, &skyLit}) scenes.push_back(std::move(*made));
  BenchScene hall = result.of("Sponza");
  const Bounds bounds = hall.model.scene.bounds();
  Light ceiling = lamp(LightType::rectangle, bounds.center() + glm::vec3(0, 0.25f * bounds.extent().y, 0),
                       bounds.center() - glm::vec3(0, bounds.extent().y, 0), 60);
  ceiling.width = 0.3f * bounds.extent().x;
  ceiling.height = 0.3f * bounds.extent().z;
  hall.model.scene.sky.intensity = 0.1f;
  scenes.push_back(litBy(std::move(hall), "Sponza, area light", {ceiling}));
  return result;
}

std::vector<Paper> publishedPapers(const PaperScenes& scenes, bool quick) {
  return {kastrati2017(scenes, quick), hu2014(scenes, quick), burger2007(scenes, quick), beck2005(scenes, quick),
          robert2007(scenes, quick)};
}

Quantity milliseconds(std::string name, double (*of)(const PaperPoint&)) { return {std::move(name), "ms", of}; }

double buildOf(const PaperPoint& point) { return point.times.voxelize.median + point.times.build.median; }

double structureOf(const PaperPoint& point) { return static_cast<double>(point.memory.structureTotal) / 1e6; }

double framesOf(const PaperPoint& point) { return 1000 / std::max(point.times.frame.median, 1e-6); }

}  // namespace halfsilver::bench
