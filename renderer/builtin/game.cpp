#include <memory>
#include <utility>
#include <vector>

#include <halfsilver/pose.h>
#include "builtin/game_parts.h"

// The level of the demo's game: a mirror ball in the atrium among platforms, gems and figures, from a start plate to a
// goal behind a gate.
namespace halfsilver {

using glm::vec3;

game::Materials game::makeMaterials(Scene& scene) {
  const auto add = [&](Material material) { return addMaterial(scene, std::move(material)); };
  const auto glowing = [](Material material, vec3 emissive) {
    material.emissive = emissive;
    return material;
  };
  Materials m{};
  m.hall = atrium::makeMaterials(scene);
  m.mirror = add(metal("ball", vec3(0.97f), 0.0f));
  m.band = add(metal("ball band", vec3(0.86f, 0.54f, 0.20f), 0.18f));
  m.gate = add(metal("gate", vec3(0.86f, 0.60f, 0.26f), 0.12f));
  m.goal = add(glowing(dielectric("goal", vec3(0.06f, 0.22f, 0.10f), 0.15f), vec3(0.02f, 0.10f, 0.04f)));
  m.deck = add(metal("platform", vec3(0.56f, 0.58f, 0.62f), 0.05f));
  m.plate = add(glowing(dielectric("plate", vec3(0.30f, 0.14f, 0.04f), 0.2f), vec3(0.55f, 0.26f, 0.06f)));
  for (int i = 0; i < kLanterns; ++i)
    m.lanterns[i] = add([&] {
      Material glass = scene.materials[m.hall.glass];
      glass.name = "lantern " + std::to_string(i + 1);
      return glass;
    }());
  m.gems[0] = add(metal("gem gold", vec3(1.0f, 0.72f, 0.22f), 0.04f));
  m.gems[1] = add(metal("gem ruby", vec3(0.85f, 0.06f, 0.10f), 0.04f));
  m.gems[2] = add(metal("gem sapphire", vec3(0.10f, 0.28f, 0.95f), 0.04f));
  m.figures[0] = add(dielectric("figure white", vec3(0.82f, 0.80f, 0.76f), 0.22f));
  m.figures[1] = add(metal("figure copper", vec3(0.90f, 0.45f, 0.28f), 0.16f));
  m.figures[2] = add(dielectric("figure blue", vec3(0.05f, 0.16f, 0.42f), 0.18f));
  m.visor = add(metal("figure visor", vec3(0.10f, 0.11f, 0.13f), 0.03f));
  return m;
}

namespace {

// The nodes as the animations begin.
void rest(Rig& rig) {
  for (const Animation& animation : rig.animations)
    for (const Channel& channel : animation.channels) {
      Node& node = rig.nodes[static_cast<std::size_t>(channel.node)];
      const bool cubic = channel.interpolation == Interpolation::cubicSpline;
      const auto value = [&](std::size_t k) { return static_cast<double>(channel.values[(cubic ? 3 : 0) + k]); };
      if (channel.property == AnimatedProperty::rotation)
        node.rotation = glm::normalize(glm::dquat(value(3), value(0), value(1), value(2)));
      else
        node.translation = {value(0), value(1), value(2)};
    }
}

// Leaves out the atrium's materials and textures that the level does not use.
void dropUnused(Scene& scene) {
  constexpr std::uint32_t kUnused = ~0u;
  std::vector<std::uint32_t> material(scene.materials.size(), kUnused), texture(scene.textures.size(), kUnused);
  for (const Triangle& triangle : scene.triangles) material[triangle.material] = 0;
  std::vector<Material> materials;
  std::vector<std::shared_ptr<const Texture>> textures;
  for (std::size_t i = 0; i < material.size(); ++i) {
    if (material[i] == kUnused) continue;
    material[i] = static_cast<std::uint32_t>(materials.size());
    Material& kept = materials.emplace_back(scene.materials[i]);
    for (TextureUse* use : {&kept.baseColorTexture, &kept.normalTexture}) {
      if (use->texture < 0) continue;
      const auto from = static_cast<std::size_t>(use->texture);
      if (texture[from] == kUnused) {
        texture[from] = static_cast<std::uint32_t>(textures.size());
        textures.push_back(scene.textures[from]);
      }
      use->texture = static_cast<int>(texture[from]);
    }
  }
  for (Triangle& triangle : scene.triangles) triangle.material = material[triangle.material];
  scene.materials = std::move(materials);
  scene.textures = std::move(textures);
}

}  // namespace

Model makeGameScene() {
  Model model;
  Scene& scene = model.scene;
  const game::Materials materials = game::makeMaterials(scene);
  MeshBuilder build;
  game::addHall(build, materials);
  game::addObstacles(build, materials);
  setMesh(scene, build.take());

  scene.lights.push_back(sunlight({0.36f, -0.80f, -0.34f}, vec3(1.0f, 0.84f, 0.62f), 9.5f));
  model.rig.lightNodes.push_back(-1);
  scene.sky.zenith = vec3(0.26f, 0.46f, 0.92f);
  scene.sky.horizon = vec3(0.86f, 0.86f, 0.84f);
  scene.sky.ground = vec3(0.20f, 0.16f, 0.12f);
  scene.sky.intensity = 0.55f;

  game::addBall(model, materials);
  game::addItems(model, materials, game::addPlatforms(model, materials));
  game::addPlates(model, materials);
  game::addGoal(model, materials);
  game::addLanterns(model);
  game::addRoute(model);
  game::addFigures(model, materials);

  scene.cameras.push_back(lookAt("start", {1.1f, 1.35f, 13.3f}, {-0.15f, 0.95f, 4.0f}, 55));
  scene.cameras.push_back(lookAt("figures", {2.6f, 1.5f, 3.4f}, {-0.6f, 1.1f, -2.0f}, 55));
  scene.cameras.push_back(lookAt("platform", {4.3f, 1.9f, 8.6f}, {5.4f, 0.5f, 1.0f}, 55));
  scene.cameras.push_back(lookAt("goal", {-1.4f, 1.5f, -5.6f}, {0.2f, 0.7f, -12.0f}, 55));
  model.rig.cameraNodes.assign(scene.cameras.size(), -1);
  dropUnused(scene);
  rest(model.rig);
  pose(model, evaluate(model.rig, {}));
  return model;
}

}  // namespace halfsilver
