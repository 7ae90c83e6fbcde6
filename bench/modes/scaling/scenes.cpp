#include "bench/modes/scaling/scenes.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "builtin/parts.h"

namespace halfsilver::bench {
namespace {

using glm::dvec3;

std::uint32_t addTwoSided(Scene& scene, Material material) {
  material.doubleSided = true;
  return addMaterial(scene, std::move(material));
}

// One sun, and point lights on a ring that share a fixed amount of light.
void addLights(Scene& scene, std::size_t count) {
  scene.sky = clearSky();
  scene.lights.push_back(sunlight({-0.55f, -0.80f, -0.45f}, glm::vec3(1.0f, 0.94f, 0.84f), 5.0f));
  for (std::size_t i = 1; i < count; ++i) {
    const auto angle = static_cast<float>(2 * kPi * static_cast<double>(i) / static_cast<double>(count));
    Light light;
    light.type = LightType::point;
    light.position = {1.6f * std::cos(angle), 2.5f, 1.6f * std::sin(angle)};
    light.color = {0.6f + 0.4f * std::cos(angle), 0.7f, 0.6f + 0.4f * std::sin(angle)};
    light.intensity = 30.0f / static_cast<float>(count);
    scene.lights.push_back(light);
  }
}

// A (2, 3) torus knot as a rippled bar. `s` goes along it, `t` around it, both 0..1.
dvec3 knot(double s, double t) {
  constexpr double kRing = 0.85, kSwing = 0.35, kHeight = 0.75, kRadius = 0.2, kRipple = 0.12;
  const double turn = 4 * kPi * s, twist = 6 * kPi * s, around = -2 * kPi * t;
  const double distance = kRing + kSwing * std::cos(twist);
  const dvec3 outwards(std::cos(turn), 0, std::sin(turn)), onwards(-outwards.z, 0, outwards.x);
  const dvec3 center = distance * outwards + dvec3(0, kHeight + kSwing * std::sin(twist), 0);
  const dvec3 along = glm::normalize(2 * distance * onwards - 3 * kSwing * std::sin(twist) * outwards +
                                     dvec3(0, 3 * kSwing * std::cos(twist), 0));
  const dvec3 side = glm::normalize(glm::cross(along, dvec3(0, 1, 0))), up = glm::cross(side, along);
  const double radius = kRadius * (1 + kRipple * std::sin(36 * kPi * s) * std::cos(3 * around));
  return center + radius * (std::cos(around) * side + std::sin(around) * up);
}

}  // namespace

Model subdividedScene(std::size_t triangles, std::size_t lights) {
  Model model;
  Scene& scene = model.scene;
  const std::uint32_t mirror = addTwoSided(scene, metal("mirror", glm::vec3(0.92f), 0));
  const std::uint32_t clay = addTwoSided(scene, dielectric("clay", glm::vec3(0.75f, 0.28f, 0.12f), 0.6f));

  constexpr double kWidth = 2, kDepth = 5, kHeight = 3;
  constexpr std::size_t kMirrorTriangles = 6;
  constexpr double kLongByRound = 9;  // columns per row, for triangles that are neither long nor thin
  const double cells = static_cast<double>(std::max(triangles, kMirrorTriangles + 2) - kMirrorTriangles) / 2;
  const int rows = std::max(1, static_cast<int>(std::lround(std::sqrt(cells / kLongByRound))));
  const int columns = static_cast<int>(std::lround(cells / rows));

  MeshBuilder build;
  build.reserve(static_cast<std::size_t>(columns + 1) * static_cast<std::size_t>(rows + 1) + 12, triangles + 8);
  build.use(mirror).rectangle({-kWidth, 0, -kDepth}, {2 * kWidth, 0, 0}, {0, 0, 2 * kDepth});
  build.rectangle({-kWidth, kHeight, kDepth}, {0, 0, -2 * kDepth}, {0, -kHeight, 0});
  build.rectangle({kWidth, kHeight, -kDepth}, {0, 0, 2 * kDepth}, {0, -kHeight, 0});
  build.use(clay).surface(columns, rows, glm::dvec2(1), knot);
  setMesh(scene, build.take());
  addLights(scene, lights);
  scene.cameras.push_back(lookAt("between", {-1.6f, 1.1f, 1.9f}, {1.5f, 0.9f, -0.1f}, 50));
  return model;
}

Model crowdedScene(std::size_t triangles, std::size_t lights) {
  Model model;
  Scene& scene = model.scene;
  const std::uint32_t mirror = addTwoSided(scene, metal("mirror", glm::vec3(0.92f), 0));
  std::vector<Mesh> pillars;
  for (const auto& [name, color] : {std::pair("red", glm::vec3(0.70f, 0.05f, 0.04f)),
                                    {"yellow", {0.85f, 0.62f, 0.08f}},
                                    {"green", {0.08f, 0.42f, 0.12f}},
                                    {"blue", {0.05f, 0.14f, 0.62f}}}) {
    MeshBuilder build;
    const std::uint32_t material = addTwoSided(scene, dielectric(name, color, 0.6f));
    // A shaft with a dome on it.
    build.use(material).lathe(Profile().arc({0, 1.2}, 0.25, 0.5 * kPi, 0, 3).lines({{0.25, 1.2}, {0.25, 0}}), {}, 14);
    pillars.push_back(build.take());
  }

  constexpr double kApart = 1.1;
  constexpr double kSeen = 6;  // how far the camera sees the floor
  const double count = std::round(static_cast<double>(triangles) / static_cast<double>(pillars[0].triangles.size()));
  const int side = static_cast<int>(std::ceil(std::sqrt(std::max(1.0, count))));
  const double half = std::max(kSeen, 0.5 * kApart * (side + 1));

  MeshBuilder build;
  build.reserve(static_cast<std::size_t>(count + 1) * pillars[0].vertices.size(), triangles + 1000);
  build.use(mirror).rectangle({-half, 0, -half}, {2 * half, 0, 0}, {0, 0, 2 * half});
  for (int i = 0; i < static_cast<int>(count); ++i) {
    // Multiples of the distance from the middle: what is in front of the camera is there in a larger world, too.
    const int column = i % side - side / 2, row = i / side - side / 2;
    const std::size_t color = static_cast<std::size_t>(column + 2 * row + 4 * side) % pillars.size();
    build.append(pillars[color], {{column * kApart, 0, row * kApart}, 0.4 * column + 0.7 * row});
  }
  setMesh(scene, build.take());
  addLights(scene, lights);
  scene.cameras.push_back(lookAt("above", {0.3f, 2.4f, 2.4f}, {0.2f, 0.2f, 0.6f}, 45));
  return model;
}

}  // namespace halfsilver::bench
