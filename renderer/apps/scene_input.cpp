#include "apps/scene_input.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include <halfsilver/builtin.h>
#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include <halfsilver/pose.h>

namespace halfsilver {
namespace {

[[noreturn]] void reject(const std::string& what) { throw Error(ErrorKind::usage, what); }

std::optional<std::size_t> indexOf(const std::string& text) {
  std::size_t index = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, index);
  if (parsed.ec != std::errc() || parsed.ptr != end) return std::nullopt;
  return index;
}

std::string animationName(const std::vector<Animation>& animations, std::size_t index) {
  return std::to_string(index) + " '" + animations[index].name + "'";
}

const Camera& cameraByName(std::span<const Camera> cameras, const std::string& name) {
  const auto found =
      std::find_if(cameras.begin(), cameras.end(), [&](const Camera& camera) { return camera.name == name; });
  if (found != cameras.end()) return *found;
  if (const auto index = indexOf(name); index && *index < cameras.size()) return cameras[*index];
  std::vector<std::string> names;
  for (std::size_t i = 0; i < cameras.size(); ++i) names.push_back(std::to_string(i) + " '" + cameras[i].name + "'");
  reject("unknown camera '" + name + "'; " + (names.empty() ? "the scene has none" : "known are " + listNames(names)));
}

Camera cameraFromWorld(const glm::dvec3& origin, const glm::dvec3& eye, const glm::dvec3& target) {
  const glm::dvec3 direction = target - eye;
  const double length = glm::length(direction);
  if (!(length > 0) || !std::isfinite(length)) reject("--eye and --target are the same point or too far apart");
  Camera camera;
  camera.name = "command line";
  camera.eye = glm::vec3(eye - origin);
  camera.target = glm::vec3(target - origin);
  // If the view is straight up or down, the top of the picture is -z, as on a map.
  if (std::abs(direction.y) > 0.9999 * length) camera.up = glm::vec3(0, 0, -1);
  return camera;
}

}  // namespace

Model loadScene(const std::string& name, const std::string& variant) {
  constexpr std::string_view prefix = "builtin:";
  if (!name.starts_with(prefix)) return loadGltf(name, {.variant = variant});
  if (!variant.empty()) reject("unknown variant '" + variant + "'; the scene has none");
  return makeBuiltin(std::string_view(name).substr(prefix.size()));
}

void applyMirrors(Scene& scene, std::span<const MirrorArgument> mirrors) {
  for (const MirrorArgument& mirror : mirrors) {
    bool found = mirror.material == "*";
    for (Material& material : scene.materials) {
      if (mirror.material != "*" && material.name != mirror.material) continue;
      material.mirror = mirror.reflectivity;
      found = true;
    }
    if (found) continue;
    std::vector<std::string> names;
    for (const Material& material : scene.materials) names.push_back(material.name);
    reject("--mirror: unknown material '" + mirror.material + "'; known are " + listNames(names));
  }
}

void addLights(Model& model, std::span<const LightArgument> lights) {
  for (const LightArgument& argument : lights) {
    Light& light = model.scene.lights.emplace_back(argument.light);
    light.position = glm::vec3(argument.position - model.scene.origin);
  }
  model.rig.lightNodes.resize(model.scene.lights.size(), -1);
}

Camera chooseCamera(std::span<const Camera> cameras, const Bounds& bounds, const glm::dvec3& origin,
                    const CameraRequest& request) {
  if (request.eye.has_value() != request.target.has_value()) reject("--eye and --target must be given together");
  if (request.eye && !request.name.empty()) reject("--camera and --eye cannot be combined");
  Camera camera;
  if (request.eye)
    camera = cameraFromWorld(origin, *request.eye, *request.target);
  else if (!request.name.empty())
    camera = cameraByName(cameras, request.name);
  else
    camera = cameras.empty() ? frameAll(bounds) : cameras.front();
  if (request.fov) {
    if (!(*request.fov > 0 && *request.fov < 180)) reject("--fov must be between 0 and 180 degrees");
    camera.verticalFov = static_cast<float>(glm::radians(*request.fov));
    camera.parallelHeight = 0;
  }
  return camera;
}

Camera chooseCamera(const Scene& scene, const CameraRequest& request) {
  return chooseCamera(scene.cameras, scene.bounds(), scene.origin, request);
}

std::vector<int> chooseAnimations(const Rig& rig, const std::string& name, std::vector<std::string>& warnings) {
  const std::vector<Animation>& animations = rig.animations;
  if (name.empty() || name == "all") {
    std::vector<int> compatible = compatibleAnimations(rig);
    std::vector<std::string> others;
    for (std::size_t a = 0; a < animations.size(); ++a)
      if (!std::binary_search(compatible.begin(), compatible.end(), static_cast<int>(a)))
        others.push_back(animationName(animations, a));
    if (!others.empty())
      warnings.push_back("not played, since they move what earlier animations move (see --animation): " +
                         listNames(others));
    return compatible;
  }
  const auto named = std::find_if(animations.begin(), animations.end(),
                                  [&](const Animation& animation) { return animation.name == name; });
  if (named != animations.end()) return {static_cast<int>(named - animations.begin())};
  if (const auto index = indexOf(name); index && *index < animations.size()) return {static_cast<int>(*index)};
  std::vector<std::string> names;
  for (std::size_t a = 0; a < animations.size(); ++a) names.push_back(animationName(animations, a));
  reject("unknown animation '" + name + "'; " +
         (names.empty() ? "the scene has none" : "known are all, " + listNames(names)));
}

std::string listNames(const std::vector<std::string>& names) {
  constexpr std::size_t max = 40;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), max); ++i) list += (i ? ", " : "") + names[i];
  if (names.size() > max) list += " and " + std::to_string(names.size() - max) + " more";
  return list;
}

}  // namespace halfsilver
