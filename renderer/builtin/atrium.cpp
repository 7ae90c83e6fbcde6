#include "builtin/atrium_parts.h"

// An arcaded two-story hall in the afternoon sun: fluted columns, vaulted aisles, galleries with thin railings,
// banners and curtains, plants cut out of their texture, lanterns, and a polished marble floor.
namespace halfsilver {

using glm::vec3;

namespace {

Material textured(Material material, TextureUse color, TextureUse normal = {}) {
  material.baseColorTexture = color;
  material.normalTexture = normal;
  return material;
}

Material thin(Material material) {
  material.doubleSided = true;
  return material;
}

}  // namespace

atrium::Materials atrium::makeMaterials(Scene& scene) {
  const auto add = [&](Material material) { return addMaterial(scene, std::move(material)); };
  const auto use = [&](std::shared_ptr<const Texture> texture) { return addTexture(scene, std::move(texture)); };
  const SurfaceTextures stone = stoneBlocks(), brick = bricks(), wood = woodPlanks();
  const TextureUse plain = use(plaster());
  Materials m{};

  // Marble under a hard polish: an index of refraction of 2.1 reflects 12.6 % at normal incidence.
  Material floor = textured(dielectric("floor", vec3(1), 0.0f), use(marbleSlabs()));
  floor.ior = 2.1f;
  m.floor = add(floor);
  m.stone = add(textured(dielectric("stone blocks", vec3(1), 0.85f), use(stone.color), use(stone.normal)));
  m.brick = add(textured(dielectric("bricks", vec3(1), 0.9f), use(brick.color), use(brick.normal)));
  m.ochre = add(textured(dielectric("ochre plaster", vec3(0.80f, 0.50f, 0.26f), 0.95f), plain));
  m.limestone = add(textured(dielectric("limestone", vec3(0.74f, 0.60f, 0.43f), 0.7f), plain));
  m.carved = add(thin(textured(dielectric("carved leaves", vec3(0.74f, 0.60f, 0.43f), 0.7f), plain)));
  m.vault = add(textured(dielectric("vault plaster", vec3(0.07f, 0.13f, 0.27f), 0.95f), plain));
  m.verde = add(textured(dielectric("green marble", vec3(0.10f, 0.24f, 0.18f), 0.45f), plain));
  m.wood = add(textured(dielectric("wood", vec3(1), 0.6f), use(wood.color), use(wood.normal)));
  m.railing = add(dielectric("railing", vec3(0.035f, 0.035f, 0.04f), 0.45f));
  m.iron = add(dielectric("iron", vec3(0.045f, 0.05f, 0.055f), 0.55f));
  m.bronze = add(metal("bronze", vec3(0.82f, 0.52f, 0.24f), 0.2f));
  m.terracotta = add(textured(dielectric("terracotta", vec3(0.60f, 0.24f, 0.12f), 0.9f), plain));
  m.soil = add(dielectric("soil", vec3(0.06f, 0.04f, 0.025f), 1.0f));
  Material leaves = thin(textured(dielectric("leaves", vec3(1), 0.7f), use(leafSprig())));
  leaves.baseColorTexture.wrapU = leaves.baseColorTexture.wrapV = Wrap::clamp;
  leaves.alphaMode = AlphaMode::mask;
  m.leaves = add(leaves);
  const vec3 gold(0.88f, 0.68f, 0.30f);
  m.drapeRed = add(
      thin(textured(dielectric("drape red", vec3(1), 0.9f), use(damask("red damask", {0.62f, 0.09f, 0.10f}, gold)))));
  m.drapeTeal = add(
      thin(textured(dielectric("drape teal", vec3(1), 0.9f), use(damask("teal damask", {0.06f, 0.34f, 0.40f}, gold)))));
  m.drapeGold = add(thin(textured(dielectric("drape gold", vec3(1), 0.9f),
                                  use(damask("gold damask", {0.84f, 0.60f, 0.20f}, {0.60f, 0.16f, 0.10f})))));
  Material glass = thin(dielectric("lantern glass", vec3(0.9f, 0.7f, 0.4f), 0.5f));
  glass.emissive = vec3(1.0f, 0.62f, 0.26f) * 6.0f;
  m.glass = add(glass);
  return m;
}

Model makeAtriumScene() {
  Model model;
  Scene& scene = model.scene;
  const atrium::Materials materials = atrium::makeMaterials(scene);

  // Both sides and both ends are alike: the second is the first, rotated by 180 degrees.
  MeshBuilder side, end, build;
  build.reserve(350000, 480000);
  side.reserve(120000, 160000);
  atrium::addArcade(side, materials);
  atrium::addColumns(side, materials);
  atrium::addRailing(side, materials);
  atrium::addEndWall(end, materials);
  atrium::addFloor(build, materials);
  for (const double turn : {0.0, kPi}) {
    build.append(side.mesh(), {glm::dvec3(0), turn});
    build.append(end.mesh(), {glm::dvec3(0), turn});
  }
  atrium::addRoofRibs(build, materials);
  atrium::addDrapes(build, materials);
  atrium::addPlants(build, materials);
  atrium::addCentrepiece(build, materials);
  atrium::addLanterns(build, materials);
  setMesh(scene, build.take());

  scene.lights.push_back(sunlight({0.36f, -0.80f, -0.34f}, vec3(1.0f, 0.84f, 0.62f), 9.5f));
  for (const double z : atrium::kLanternZ) {
    Light lantern;
    lantern.type = LightType::point;
    lantern.position = vec3(0.0f, static_cast<float>(atrium::kLanternFoot) - 0.15f, static_cast<float>(z));
    lantern.color = vec3(1.0f, 0.66f, 0.34f);
    lantern.intensity = 26.0f;
    lantern.range = 14.0f;
    scene.lights.push_back(lantern);
  }
  scene.sky.zenith = vec3(0.26f, 0.46f, 0.92f);
  scene.sky.horizon = vec3(0.86f, 0.86f, 0.84f);
  scene.sky.ground = vec3(0.20f, 0.16f, 0.12f);
  scene.sky.intensity = 0.55f;

  scene.cameras.push_back(lookAt("hall", {-1.35f, 1.30f, 12.4f}, {0.70f, 2.62f, -4.0f}, 57));
  scene.cameras.push_back(lookAt("gallery", {-3.05f, 7.3f, 6.3f}, {1.8f, 2.6f, -5.0f}, 60));
  scene.cameras.push_back(lookAt("aisle", {5.2f, 1.6f, 14.0f}, {4.9f, 2.1f, 0.0f}, 60));
  scene.cameras.push_back(lookAt("floor", {-2.0f, 0.45f, 4.6f}, {0.6f, 1.6f, -4.0f}, 55));
  return model;
}

}  // namespace halfsilver
