#include "builtin/parts.h"

// A mirror sphere of radius 1 that stands on a checkered floor among colored things, some of them behind the camera,
// visible only in the sphere.
namespace halfsilver {

Model makeSphereScene() {
  using glm::dvec3;
  Model model;
  Scene& scene = model.scene;

  Material tiles = dielectric("floor", glm::vec3(1), 0.9f);
  tiles.baseColorTexture = addTexture(scene, checker(glm::vec3(0.90f, 0.88f, 0.84f), glm::vec3(0.24f, 0.26f, 0.30f)));
  const std::uint32_t floor = addMaterial(scene, tiles);
  const std::uint32_t mirror = addMaterial(scene, metal("mirror", glm::vec3(0.95f), 0.0f));
  const std::uint32_t red = addMaterial(scene, dielectric("red", glm::vec3(0.70f, 0.05f, 0.04f), 0.6f));
  const std::uint32_t orange = addMaterial(scene, dielectric("orange", glm::vec3(0.85f, 0.30f, 0.04f), 0.6f));
  const std::uint32_t yellow = addMaterial(scene, dielectric("yellow", glm::vec3(0.85f, 0.62f, 0.08f), 0.6f));
  const std::uint32_t green = addMaterial(scene, dielectric("green", glm::vec3(0.08f, 0.42f, 0.12f), 0.6f));
  const std::uint32_t blue = addMaterial(scene, dielectric("blue", glm::vec3(0.05f, 0.14f, 0.62f), 0.6f));
  const std::uint32_t violet = addMaterial(scene, dielectric("violet", glm::vec3(0.30f, 0.08f, 0.45f), 0.6f));

  MeshBuilder build;
  constexpr double kHalf = 6;
  build.use(floor, 1.2).rectangle(dvec3(-kHalf, 0, -kHalf), dvec3(2 * kHalf, 0, 0), dvec3(0, 0, 2 * kHalf));
  build.use(mirror).lathe(Profile().arc({0, 0}, 1, 0.5 * kPi, -0.5 * kPi, 80), dvec3(0, 1, 0), 160);

  constexpr int kRound = 3;
  // In front of the camera.
  build.use(red).roundedBox({-2.1, 0, -0.9}, {0.9, 0.9, 0.9}, 0.06, kRound, 0.5);
  build.use(blue).roundedBox({2.2, 0, -1.3}, {0.8, 1.9, 0.8}, 0.06, kRound, -0.35);
  build.use(yellow).roundedBox({1.75, 0, 0.75}, {0.5, 0.5, 0.5}, 0.05, kRound, 0.8);
  build.use(green).roundedBox({-0.9, 0, -3.2}, {1.3, 1.5, 0.7}, 0.06, kRound, 0.15);
  build.use(orange).roundedBox({-1.55, 0, 1.05}, {0.34, 0.34, 0.34}, 0.04, kRound, 0.3);
  // Behind it.
  build.use(violet).roundedBox({-2.6, 0, 5.2}, {1.2, 2.2, 0.8}, 0.06, kRound, 0.4);
  build.use(orange).roundedBox({3.3, 0, 5.0}, {1.0, 1.4, 1.0}, 0.06, kRound, -0.6);
  build.use(blue).roundedBox({-4.6, 0, 2.4}, {0.9, 1.2, 0.9}, 0.06, kRound, 0.2);
  // A round pillar with a ball on it, and two out of sight.
  const auto pillar = [&](dvec3 base, double radius, double height, std::uint32_t shaft, std::uint32_t ball) {
    build.use(shaft).lathe(Profile().lines({{0, height}, {radius, height}, {radius, 0}}), base, 48);
    build.use(ball).lathe(Profile().arc({0, 0}, 0.8 * radius, 0.5 * kPi, -0.5 * kPi, 24),
                          base + dvec3(0, height + 0.8 * radius, 0), 48);
  };
  pillar({-3.6, 0, -2.6}, 0.32, 1.7, yellow, red);
  pillar({3.9, 0, 1.6}, 0.30, 1.3, green, violet);
  pillar({-0.7, 0, 5.7}, 0.34, 1.5, red, yellow);
  setMesh(scene, build.take());

  scene.sky = clearSky();
  scene.lights.push_back(sunlight({-0.55f, -0.80f, -0.45f}, glm::vec3(1.0f, 0.94f, 0.84f), 7.0f));
  scene.cameras.push_back(lookAt("front", {0.9f, 1.55f, 4.1f}, {0.05f, 0.85f, 0}, 42));
  scene.cameras.push_back(lookAt("above", {-2.6f, 3.6f, 3.4f}, {0, 0.7f, -0.2f}, 45));
  scene.cameras.push_back(lookAt("low", {-2.4f, 0.35f, 2.9f}, {0, 0.9f, 0}, 45));
  return model;
}

}  // namespace halfsilver
