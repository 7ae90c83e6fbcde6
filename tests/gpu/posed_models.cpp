#include "gpu/posed_models.h"

#include <algorithm>

#include "gpu/tracing_scenes.h"
#include "shared_scenes.h"

namespace halfsilver::testing {

PoseState poseOf(const Model& model, double seconds) {
  return evaluate(model.rig, playTogether(compatibleAnimations(model.rig), seconds));
}

double durationOf(const Model& model) {
  double duration = 0;
  for (const Animation& animation : model.rig.animations)
    duration = std::max(duration, static_cast<double>(animation.duration));
  return duration;
}

std::filesystem::path sharedCase(const std::string& name) {
  return sharedScene("").parent_path().parent_path() / "cases" / (name + ".gltf");
}

Model rigged(const glm::dvec3& restOffset) {
  Model model;
  model.scene.materials = {plain(glm::vec3(0.5f))};
  model.rig.nodes.resize(4);
  model.rig.skins.push_back({{2, 3}, {glm::dmat4(1), glm::dmat4(1)}});
  for (const int node : {0, 1, 2}) {
    Instance instance;
    instance.node = node;
    instance.firstVertex = static_cast<std::uint32_t>(model.scene.vertices.size());
    instance.firstTriangle = static_cast<std::uint32_t>(model.scene.triangles.size());
    instance.vertexCount = 3;
    instance.triangleCount = 1;
    const glm::vec3 corner = glm::vec3(restOffset) + glm::vec3(2.0f * static_cast<float>(node), 0, 0);
    addTriangle(model.scene, corner, corner + glm::vec3(1, 0, 0), corner + glm::vec3(0, 1, 0), 0);
    instance.rest.assign(model.scene.vertices.end() - 3, model.scene.vertices.end());
    if (node == 2) {
      instance.skin = 0;
      instance.joints.assign(3, glm::uvec4(0, 1, 0, 0));
      instance.weights.assign(3, glm::vec4(0.5f, 0.5f, 0, 0));
    }
    model.rig.instances.push_back(instance);
  }
  model.scene.cameras = {lookAt({2, 0.5f, 6}, {2, 0.5f, 0})};
  return model;
}

}  // namespace halfsilver::testing
