#include <halfsilver/builtin.h>

#include <array>
#include <optional>
#include <utility>

#include <halfsilver/error.h>
#include "builtin/parts.h"

namespace halfsilver {
namespace {

struct Entry {
  std::string_view name;
  Model (*make)();
};

constexpr std::array<Entry, 4> kScenes{{
    {"sphere", makeSphereScene},
    {"teapot", makeTeapotScene},
    {"atrium", makeAtriumScene},
    {"game", makeGameScene},
}};

constexpr std::array<Entry, 6> kEffectScenes{{
    {"cornell", [] { return makeCornellScene(true); }},
    {"cornell-empty", [] { return makeCornellScene(false); }},
    {"furnace", makeFurnaceScene},
    {"slab", makeSlabScene},
    {"prism", makePrismScene},
    {"glass", makeGlassScene},
}};

std::vector<std::string> namesOf(std::span<const Entry> scenes) {
  std::vector<std::string> names;
  for (const Entry& entry : scenes) names.emplace_back(entry.name);
  return names;
}

}  // namespace

std::vector<std::string> builtinNames() { return namesOf(kScenes); }

std::vector<std::string> effectSceneNames() { return namesOf(kEffectScenes); }

Model makeBuiltin(std::string_view name) {
  std::string known;
  const auto named = [&](const auto& scenes) -> std::optional<Model> {
    for (const auto& entry : scenes) {
      if (entry.name == name) return entry.make();
      known += (known.empty() ? "" : ", ") + std::string(entry.name);
    }
    return {};
  };
  std::optional<Model> model = named(kScenes);
  if (!model) model = named(kEffectScenes);
  if (!model) model = named(failureScenes());
  if (!model) throw Error(ErrorKind::badInput, "builtin:" + std::string(name) + ": no such scene; known are " + known);
  model->scene.name = "builtin:" + std::string(name);
  return std::move(*model);
}

std::uint32_t addMaterial(Scene& scene, Material material) {
  scene.materials.push_back(std::move(material));
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

TextureUse addTexture(Scene& scene, std::shared_ptr<const Texture> texture) {
  scene.textures.push_back(std::move(texture));
  TextureUse use;
  use.texture = static_cast<int>(scene.textures.size()) - 1;
  return use;
}

Material dielectric(std::string name, glm::vec3 linearColor, float roughness) {
  Material material;
  material.name = std::move(name);
  material.baseColor = glm::vec4(linearColor, 1.0f);
  material.metallic = 0;
  material.roughness = roughness;
  return material;
}

Material metal(std::string name, glm::vec3 linearColor, float roughness) {
  Material material = dielectric(std::move(name), linearColor, roughness);
  material.metallic = 1;
  return material;
}

Sky clearSky() {
  Sky sky;
  sky.zenith = glm::vec3(0.14f, 0.31f, 0.72f);
  sky.horizon = glm::vec3(0.62f, 0.74f, 0.88f);
  sky.ground = glm::vec3(0.26f, 0.24f, 0.22f);
  return sky;
}

Light sunlight(glm::vec3 travels, glm::vec3 color, float lux) {
  Light sun;
  sun.type = LightType::directional;
  sun.direction = glm::normalize(travels);
  sun.color = color;
  sun.intensity = lux;
  return sun;
}

Camera lookAt(std::string name, glm::vec3 eye, glm::vec3 target, float verticalFovDegrees) {
  Camera camera;
  camera.name = std::move(name);
  camera.eye = eye;
  camera.target = target;
  camera.verticalFov = glm::radians(verticalFovDegrees);
  return camera;
}

void setMesh(Scene& scene, Mesh mesh) {
  scene.vertices = std::move(mesh.vertices);
  scene.triangles = std::move(mesh.triangles);
}

}  // namespace halfsilver
