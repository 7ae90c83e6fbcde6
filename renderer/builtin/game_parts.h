#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "builtin/atrium_parts.h"

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

// Nodes. A mesh that is attached to one is in its node's space.
int addNode(Rig& rig, std::string name, int parent, glm::dvec3 translation);
void attach(Model& model, int node, const Mesh& mesh);

// The weights of a mesh's vertices: joints along a line, each from `at` on, blended over `blend` on both sides.
struct Chain {
  struct Link {
    std::uint32_t joint;
    double at;
  };
  std::vector<Link> links;
  glm::dvec3 origin, axis;  // position `at` of a point p is dot(p - origin, axis)
  double blend;
};
// All of a figure's mesh so far and its weights.
struct Skinned {
  Mesh mesh;
  std::vector<glm::uvec4> joints;
  std::vector<glm::vec4> weights;

  void add(const Mesh& part, const Chain& chain);
};
void attach(Model& model, int node, const Skinned& skinned, int skin);

// Channels of an animation, sampled evenly.
void addTranslations(Animation& animation, int node, int keys, const std::function<glm::dvec3(double)>& at);
void addRotations(Animation& animation, int node, int keys, const std::function<glm::dquat(double)>& at);

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
