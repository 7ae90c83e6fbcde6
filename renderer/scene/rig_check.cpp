#include "scene/rig_check.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include <halfsilver/error.h>

namespace halfsilver {
namespace {

class RigCheck {
 public:
  explicit RigCheck(const Model& model) : model_(model), rig_(model.rig) {}

  void run() const {
    for (std::size_t i = 0; i < rig_.nodes.size(); ++i)
      if (rig_.nodes[i].parent >= static_cast<int>(i))
        fail("node", i, "has the parent " + std::to_string(rig_.nodes[i].parent) + ", which must come before it");
    for (std::size_t i = 0; i < rig_.skins.size(); ++i) checkSkin(i);
    for (std::size_t i = 0; i < rig_.animations.size(); ++i)
      for (const Channel& channel : rig_.animations[i].channels)
        if (!isNode(channel.node)) fail("animation", i, "moves " + nodeText(channel.node));
    checkAttached("light", rig_.lightNodes);
    checkAttached("camera", rig_.cameraNodes);
    std::size_t firstTriangle = 0;
    for (std::size_t i = 0; i < rig_.instances.size(); ++i) {
      checkInstance(i, firstTriangle);
      firstTriangle = std::size_t{rig_.instances[i].firstTriangle} + rig_.instances[i].triangleCount;
    }
  }

 private:
  [[noreturn]] void fail(const char* kind, std::size_t index, const std::string& what) const {
    throw Error(ErrorKind::usage,
                "scene '" + model_.scene.name + "': " + kind + " " + std::to_string(index) + " " + what);
  }
  bool isNode(int node) const { return node >= 0 && static_cast<std::size_t>(node) < rig_.nodes.size(); }
  std::string nodeText(int node) const {
    return "node " + std::to_string(node) + " of " + std::to_string(rig_.nodes.size());
  }

  void checkSkin(std::size_t index) const {
    const Skin& skin = rig_.skins[index];
    for (const int joint : skin.joints)
      if (!isNode(joint)) fail("skin", index, "has as a joint " + nodeText(joint));
    if (skin.inverseBind.size() != skin.joints.size())
      fail("skin", index,
           "has " + std::to_string(skin.inverseBind.size()) + " inverse bind matrices for " +
               std::to_string(skin.joints.size()) + " joints");
  }

  // -1: to none.
  void checkAttached(const char* kind, const std::vector<int>& nodes) const {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (nodes[i] >= 0 && !isNode(nodes[i])) fail(kind, i, "is attached to " + nodeText(nodes[i]));
  }

  void checkInstance(std::size_t index, std::size_t firstTriangle) const {
    const Instance& instance = rig_.instances[index];
    const auto expect = [&](bool holds, const char* what) {
      if (!holds) fail("instance", index, what);
    };
    const std::size_t vertices = instance.rest.size();
    if (!isNode(instance.node)) fail("instance", index, "is placed by " + nodeText(instance.node));
    expect(instance.vertexCount == vertices, "has another number of vertices than of rest positions");
    expect(std::size_t{instance.firstVertex} + vertices <= model_.scene.vertices.size(),
           "has vertices beyond the scene's");
    expect(instance.firstTriangle >= firstTriangle, "has triangles before the end of those of the instance before it");
    expect(std::size_t{instance.firstTriangle} + instance.triangleCount <= model_.scene.triangles.size(),
           "has triangles beyond the scene's");
    expect(!instance.flatNormals || vertices % 3 == 0, "has flat normals, but its vertices are not whole triangles");
    for (const Instance::MorphTarget& target : instance.targets)
      for (const auto* deltas : {&target.positions, &target.normals, &target.tangents})
        expect(deltas->empty() || deltas->size() == vertices, "has a morph target of another number of vertices");
    if (instance.skin >= 0) checkInfluences(index, vertices);
  }

  void checkInfluences(std::size_t index, std::size_t vertices) const {
    const Instance& instance = rig_.instances[index];
    const auto skin = static_cast<std::size_t>(instance.skin);
    if (skin >= rig_.skins.size()) fail("instance", index, "names skin " + std::to_string(skin) + ", which is none");
    const std::size_t joints = rig_.skins[skin].joints.size();
    if (joints == 0) fail("instance", index, "has a skin without joints");
    const std::size_t sets = instance.jointSets;
    if (sets == 0 || instance.joints.size() != sets * vertices || instance.weights.size() != sets * vertices)
      fail("instance", index, "has not as many sets of joints and weights per vertex as it says");
    for (std::size_t set = 0; set < sets * vertices; ++set)
      for (int k = 0; k < 4; ++k)
        if (instance.joints[set][k] >= joints)
          fail("instance", index,
               "has at vertex " + std::to_string(set / sets) + " the joint " + std::to_string(instance.joints[set][k]) +
                   " of " + std::to_string(joints));
  }

  const Model& model_;
  const Rig& rig_;
};

}  // namespace

void checkRig(const Model& model) { RigCheck(model).run(); }

}  // namespace halfsilver
