#include "apps/demo/game/level.h"

#include <algorithm>
#include <string>

#include <halfsilver/error.h>
#include <halfsilver/pose.h>

namespace halfsilver::demo {
namespace {

constexpr double kCell = 0.6;  // meters

template <class Named>
int find(const std::vector<Named>& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Named& one) { return one.name == name; });
  return found == all.end() ? -1 : static_cast<int>(found - all.begin());
}

// "kind 1", "kind 2" and so on.
template <class Named>
std::vector<int> numbered(const std::vector<Named>& all, const std::string& kind) {
  std::vector<int> found;
  for (int at; (at = find(all, kind + " " + std::to_string(found.size() + 1))) >= 0;) found.push_back(at);
  return found;
}

int needed(int found, const std::string& what) {
  if (found < 0) throw Error(ErrorKind::badInput, "this scene is not a level of the game: it has no " + what);
  return found;
}

std::vector<Corners> shapeOf(const Model& model, int node) {
  std::vector<Corners> shape;
  for (const Instance& instance : model.rig.instances) {
    if (instance.node != node) continue;
    for (std::uint32_t t = 0; t < instance.triangleCount; ++t) {
      Corners& corners = shape.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = model.scene.triangles[instance.firstTriangle + t].vertices[k];
        corners[k] = instance.rest[vertex - instance.firstVertex].position;
      }
    }
  }
  return shape;
}

}  // namespace

Level::Level(const Model& model) {
  const std::vector<Node>& nodes = model.rig.nodes;
  const std::vector<Material>& materials = model.scene.materials;
  ball = needed(find(nodes, "ball"), "node 'ball'");
  goal = needed(find(nodes, "goal"), "node 'goal'");
  gate = needed(find(nodes, "gate"), "node 'gate'");
  goalMaterial = needed(find(materials, "goal"), "material 'goal'");
  items = numbered(nodes, "item");
  if (items.empty()) needed(-1, "node 'item 1'");
  plates = numbered(nodes, "plate");
  figures = numbered(nodes, "figure");
  route = numbered(nodes, "route");
  platforms = numbered(nodes, "platform");
  platforms.push_back(gate);
  for (const int node : platforms) shapes.push_back(shapeOf(model, node));
  lanternMaterials = numbered(materials, "lantern");
  for (const int node : numbered(nodes, "lantern")) {
    const auto light = std::find(model.rig.lightNodes.begin(), model.rig.lightNodes.end(), node);
    lanternLights.push_back(needed(light == model.rig.lightNodes.end() ? -1 : 0, "light at a node 'lantern'") +
                            static_cast<int>(light - model.rig.lightNodes.begin()));
  }
  if (lanternLights.size() != lanternMaterials.size() || plates.size() != lanternLights.size())
    needed(-1, "light, material and plate for each of its lanterns");
  animations = compatibleAnimations(model.rig);
}

TriangleGrid Level::ground(const Model& model) {
  const Scene& scene = model.scene;
  std::vector<bool> moves(scene.triangles.size());
  for (const Instance& instance : model.rig.instances)
    for (std::uint32_t t = 0; t < instance.triangleCount; ++t) moves[instance.firstTriangle + t] = true;
  std::vector<Corners> triangles;
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const Triangle& triangle = scene.triangles[t];
    if (moves[t] || scene.materials[triangle.material].alphaMode == AlphaMode::mask) continue;
    Corners& corners = triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = scene.origin + glm::dvec3(scene.vertices[triangle.vertices[k]].position);
  }
  return TriangleGrid(std::move(triangles), kCell);
}

}  // namespace halfsilver::demo
