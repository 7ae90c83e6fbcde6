#include "builtin/rig_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace halfsilver {
namespace {

using glm::dvec3;

Instance& addInstance(Model& model, int node, const Mesh& mesh) {
  Scene& scene = model.scene;
  const auto firstVertex = static_cast<std::uint32_t>(scene.vertices.size());
  Instance instance;
  instance.node = instance.mesh = node;
  instance.primitive = 0;
  instance.firstVertex = firstVertex;
  instance.vertexCount = static_cast<std::uint32_t>(mesh.vertices.size());
  instance.firstTriangle = static_cast<std::uint32_t>(scene.triangles.size());
  instance.triangleCount = static_cast<std::uint32_t>(mesh.triangles.size());
  instance.rest = mesh.vertices;
  scene.vertices.insert(scene.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
  for (Triangle triangle : mesh.triangles) {
    for (std::uint32_t& vertex : triangle.vertices) vertex += firstVertex;
    scene.triangles.push_back(triangle);
  }
  return model.rig.instances.emplace_back(std::move(instance));
}

// Keys at even times from 0 to the animation's end.
Channel channelOf(const Animation& animation, int node, AnimatedProperty property, int keys) {
  Channel channel;
  channel.node = node;
  channel.property = property;
  for (int i = 0; i <= keys; ++i)
    channel.times.push_back(animation.duration * static_cast<float>(i) / static_cast<float>(keys));
  return channel;
}

double smoothStep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

int addNode(Rig& rig, std::string name, int parent, dvec3 translation) {
  Node node;
  node.name = std::move(name);
  node.parent = parent;
  node.translation = translation;
  rig.nodes.push_back(std::move(node));
  return static_cast<int>(rig.nodes.size()) - 1;
}

void attach(Model& model, int node, const Mesh& mesh) { addInstance(model, node, mesh); }

void attach(Model& model, int node, const Skinned& skinned, int skin) {
  Instance& instance = addInstance(model, node, skinned.mesh);
  instance.skin = skin;
  instance.joints = skinned.joints;
  instance.weights = skinned.weights;
}

void Skinned::add(const Mesh& part, const Chain& chain) {
  const auto firstVertex = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vertex& vertex : part.vertices) {
    mesh.vertices.push_back(vertex);
    const double at = glm::dot(dvec3(vertex.position) - chain.origin, chain.axis);
    // The share of all joints from the k-th on; a joint's own is the difference to the next one's.
    glm::uvec4 joint(0);
    glm::vec4 weight(0);
    double share = 1;
    for (std::size_t k = 0; k < chain.links.size(); ++k) {
      const bool last = k + 1 == chain.links.size();
      const double rest =
          last ? 0 : smoothStep(chain.links[k + 1].at - chain.blend, chain.links[k + 1].at + chain.blend, at);
      joint[static_cast<int>(k)] = chain.links[k].joint;
      weight[static_cast<int>(k)] = static_cast<float>(share - std::min(rest, share));
      share = std::min(rest, share);
    }
    joints.push_back(joint);
    weights.push_back(weight);
  }
  for (Triangle triangle : part.triangles) {
    for (std::uint32_t& vertex : triangle.vertices) vertex += firstVertex;
    mesh.triangles.push_back(triangle);
  }
}

void addTranslations(Animation& animation, int node, int keys, const std::function<dvec3(double)>& at) {
  Channel channel = channelOf(animation, node, AnimatedProperty::translation, keys);
  for (const float time : channel.times) {
    const dvec3 value = at(static_cast<double>(time));
    for (int axis = 0; axis < 3; ++axis) channel.values.push_back(static_cast<float>(value[axis]));
  }
  animation.channels.push_back(std::move(channel));
}

void addRotations(Animation& animation, int node, int keys, const std::function<glm::dquat(double)>& at) {
  Channel channel = channelOf(animation, node, AnimatedProperty::rotation, keys);
  for (const float time : channel.times) {
    const glm::dquat value = at(static_cast<double>(time));
    for (const double part : {value.x, value.y, value.z, value.w}) channel.values.push_back(static_cast<float>(part));
  }
  animation.channels.push_back(std::move(channel));
}

}  // namespace halfsilver
