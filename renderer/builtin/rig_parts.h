#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <halfsilver/model.h>
#include "builtin/mesh_builder.h"

// Nodes, skins and animations of models that are made in code.
namespace halfsilver {

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

}  // namespace halfsilver
