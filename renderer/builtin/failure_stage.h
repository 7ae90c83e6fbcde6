#pragma once

#include <span>
#include <utility>

#include "builtin/parts.h"

// What the failure scenes share, and those of them that engines say their software tracing cannot do.
namespace halfsilver {

// A 4 m mirror floor under things of four colors, seen from above.
class Stage {
 public:
  Stage() {
    mirror = addMaterial(model.scene, metal("mirror", glm::vec3(0.95f), 0.0f));
    for (const auto& [name, color] : {std::pair("red", glm::vec3(0.70f, 0.05f, 0.04f)),
                                      {"yellow", {0.85f, 0.62f, 0.08f}},
                                      {"green", {0.08f, 0.42f, 0.12f}},
                                      {"blue", {0.05f, 0.14f, 0.62f}},
                                      {"moving", {0.85f, 0.30f, 0.04f}}}) {
      Material material = dielectric(name, color, 0.6f);
      material.doubleSided = true;
      addMaterial(model.scene, material);
    }
    model.scene.cameras.push_back(lookAt("front", {0.3f, 1.5f, 3.4f}, {0, 0.25f, 0}, 45));
  }

  void floor(double half = 2) {
    build.use(mirror).rectangle(glm::dvec3(-half, 0, -half), glm::dvec3(2 * half, 0, 0), glm::dvec3(0, 0, 2 * half));
  }
  void ball(std::uint32_t material, glm::dvec3 center, double radius, int segments = 24) {
    build.use(material).lathe(Profile().arc({0, 0}, radius, 0.5 * kPi, -0.5 * kPi, segments), center, 2 * segments);
  }
  // With its own corners, counter-clockwise.
  void triangle(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a)), tangent = glm::normalize(b - a);
    const std::uint32_t first = build.vertex({a, normal, tangent, {0, 0}});
    build.vertex({b, normal, tangent, {1, 0}});
    build.vertex({c, normal, tangent, {0, 1}});
    build.triangle(first, first + 1, first + 2);
  }

  Model finish() {
    setMesh(model.scene, build.take());
    model.scene.sky = clearSky();
    model.scene.lights.push_back(sunlight({-0.55f, -0.80f, -0.45f}, glm::vec3(1.0f, 0.94f, 0.84f), 7.0f));
    return std::move(model);
  }

  Model model;
  MeshBuilder build;
  std::uint32_t mirror = 0;
  static constexpr std::uint32_t red = 1, yellow = 2, green = 3, blue = 4, moving = 5;
};

// Limits that a widely used engine's documentation names (Unreal Engine 5, Lumen's software ray tracing).
Model makeFigures();
Model makeRipples();
Model makeCanopy();
Model makePanes();
Model makeThinWalls();
Model makeOneMesh();
Model makeRibbons();

// See SlowMove::shape.
void shapeRipples(std::span<Vertex> vertices, int frame);
void shapeCanopy(std::span<Vertex> vertices, int frame);

}  // namespace halfsilver
