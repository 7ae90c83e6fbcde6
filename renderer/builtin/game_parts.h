#pragma once

#include <string>
#include <vector>

#include "builtin/atrium_parts.h"
#include "builtin/rig_parts.h"

// The parts of builtin:game; private to the builtin_game files. Its hall is the atrium with fewer triangles, so that a
// software rasterizer draws it in play; what moves is a node each, named as renderer/apps/demo/game/README.md lists.
namespace halfsilver::game {

inline constexpr double kBallRadius = 0.4;
inline constexpr int kLanterns = 4;

struct Materials {
  atrium::Materials hall;
  std::uint32_t mirror, band, gate, goal, deck, plate;
  std::uint32_t lanterns[kLanterns];
  std::uint32_t gems[3];
  std::uint32_t figures[3], visor;
};

// What the game adds to the atrium's materials.
Materials makeMaterials(Scene& scene);

// Static parts, in world space.
void addHall(MeshBuilder& build, const Materials& materials);
void addObstacles(MeshBuilder& build, const Materials& materials);  // steps, ramps and blocks

void addBall(Model& model, const Materials& materials);
void addItems(Model& model, const Materials& materials, int carpet);
// Returns the node of the low platform in the nave, which carries an item.
int addPlatforms(Model& model, const Materials& materials);
void addPlates(Model& model, const Materials& materials);
void addGoal(Model& model, const Materials& materials);
void addLanterns(Model& model);  // their lights
// The way of a round for whoever plays by itself: points on the floor in order, on a platform as its children.
void addRoute(Model& model);
void addFigures(Model& model, const Materials& materials);

}  // namespace halfsilver::game
