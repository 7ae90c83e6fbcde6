#pragma once

#include <glm/glm.hpp>
#include <string_view>
#include <vector>

#include <halfsilver/model.h>
#include "apps/demo/game/triangle_grid.h"

// What a model has to contain to be played, found by the names of its nodes and materials (see README.md).
namespace halfsilver::demo {

struct Level {
  // Throws Error (badInput) naming what is missing.
  explicit Level(const Model& model);

  int ball = -1, goal = -1, gate = -1;               // nodes
  std::vector<int> items, plates, figures, route;    // nodes, in the order of their numbers
  std::vector<int> platforms;                        // nodes; the gate is the last
  std::vector<std::vector<Corners>> shapes;          // of the platforms, in their own space
  std::vector<int> lanternLights, lanternMaterials;  // of lantern i: into Scene::lights and Scene::materials
  int goalMaterial = -1;
  std::vector<int> animations;  // all that play together

  // What never moves, in world space, without what is cut out by alpha.
  static TriangleGrid ground(const Model& model);
};

}  // namespace halfsilver::demo
