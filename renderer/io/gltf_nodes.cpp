#include "io/gltf_nodes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

namespace halfsilver::gltf {
namespace {

void requireLength(const std::vector<double>& values, std::size_t length, const char* what,
                   const Diagnostics& diagnostics, const std::string& where) {
  if (!values.empty() && values.size() != length)
    diagnostics.fail(
        std::string(what) + " has " + std::to_string(values.size()) + " numbers, not " + std::to_string(length), where);
}

glm::dmat4 affineMatrix(const std::vector<double>& values, const Diagnostics& diagnostics, const std::string& where) {
  constexpr double kTolerance = 1e-5;
  glm::dmat4 matrix;
  for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = values[static_cast<std::size_t>(i)];
  for (int column = 0; column < 4; ++column) {
    if (std::abs(matrix[column][3] - (column == 3 ? 1 : 0)) > kTolerance)
      diagnostics.fail("has a matrix that is not affine", where);
    matrix[column][3] = column == 3 ? 1 : 0;
  }
  return matrix;
}

halfsilver::Node convert(const Document& document, const Node& source, Diagnostics& diagnostics,
                         const std::string& where) {
  halfsilver::Node node;
  node.name = source.name;
  requireLength(source.matrix, 16, "matrix", diagnostics, where);
  requireLength(source.translation, 3, "translation", diagnostics, where);
  requireLength(source.rotation, 4, "rotation", diagnostics, where);
  requireLength(source.scale, 3, "scale", diagnostics, where);
  if (!source.matrix.empty()) {
    node.hasMatrix = true;
    node.matrix = affineMatrix(source.matrix, diagnostics, where);
  }
  if (const auto& t = source.translation; !t.empty()) node.translation = {t[0], t[1], t[2]};
  if (const auto& s = source.scale; !s.empty()) node.scale = {s[0], s[1], s[2]};
  if (const auto& r = source.rotation; !r.empty()) {
    const double length = std::hypot(std::hypot(r[0], r[1]), std::hypot(r[2], r[3]));
    if (length > 0 && std::isfinite(length))
      node.rotation = glm::dquat(r[3] / length, r[0] / length, r[1] / length, r[2] / length);
    else
      diagnostics.warn("a rotation without a direction was ignored: " + where);
  }
  const std::vector<double>* weights = &source.weights;
  if (source.mesh >= 0) {
    const Mesh& mesh = get(document.meshes, source.mesh, "meshes", diagnostics, where);
    if (weights->empty()) weights = &mesh.weights;
  }
  for (const double weight : *weights) node.weights.push_back(static_cast<float>(weight));
  return node;
}

std::vector<int> parentsOf(const Document& document, const Diagnostics& diagnostics) {
  std::vector<int> parents(document.nodes.size(), -1);
  for (std::size_t n = 0; n < document.nodes.size(); ++n)
    for (const int child : document.nodes[n].children) {
      get(document.nodes, child, "nodes", diagnostics, item("nodes", n) + ".children");
      int& parent = parents[static_cast<std::size_t>(child)];
      if (parent >= 0)
        diagnostics.fail("has two parents, nodes " + std::to_string(parent) + " and " + std::to_string(n),
                         item("nodes", static_cast<std::size_t>(child)));
      parent = static_cast<int>(n);
    }
  return parents;
}

float ranged(double value, double low, double high, const char* what, Diagnostics& diagnostics,
             const std::string& where) {
  if (!(value >= low && value <= high)) {
    diagnostics.warn(std::string(what) + " is out of range and was clamped: " + where);
    value = value > high ? high : low;
  }
  return static_cast<float>(value);
}

}  // namespace

std::string nodeName(const Document& document, int fileNode) {
  const std::string& name = document.nodes[static_cast<std::size_t>(fileNode)].name;
  return name.empty() ? "node " + std::to_string(fileNode) : name;
}

Hierarchy buildHierarchy(const Document& document, Diagnostics& diagnostics) {
  const std::vector<int> parents = parentsOf(document, diagnostics);
  Hierarchy hierarchy;
  hierarchy.rigNode.assign(document.nodes.size(), -1);
  const auto visit = [&](int root) {
    std::vector<int> waiting{root};
    while (!waiting.empty()) {
      const int n = waiting.back();
      waiting.pop_back();
      const auto index = static_cast<std::size_t>(n);
      if (hierarchy.rigNode[index] >= 0) continue;
      const Node& source = document.nodes[index];
      halfsilver::Node node = convert(document, source, diagnostics, item("nodes", index));
      const int parent = parents[index];
      node.parent = parent < 0 ? -1 : hierarchy.rigNode[static_cast<std::size_t>(parent)];
      hierarchy.rigNode[index] = static_cast<int>(hierarchy.nodes.size());
      hierarchy.nodes.push_back(std::move(node));
      hierarchy.fileNode.push_back(n);
      waiting.insert(waiting.end(), source.children.rbegin(), source.children.rend());
    }
  };
  if (document.sceneNodes) {
    for (const int node : *document.sceneNodes) {
      get(document.nodes, node, "nodes", diagnostics, "scenes.nodes");
      if (parents[static_cast<std::size_t>(node)] >= 0)
        diagnostics.fail("a scene names a node that is not a root", item("nodes", static_cast<std::size_t>(node)));
      visit(node);
    }
    hierarchy.inScene = hierarchy.nodes.size();
  }
  // Joints and animations may name nodes outside the scene.
  for (std::size_t n = 0; n < document.nodes.size(); ++n)
    if (parents[n] < 0) visit(static_cast<int>(n));
  if (!document.sceneNodes) hierarchy.inScene = hierarchy.nodes.size();
  const auto unreached = std::find(hierarchy.rigNode.begin(), hierarchy.rigNode.end(), -1);
  if (unreached != hierarchy.rigNode.end())
    diagnostics.fail("is its own ancestor",
                     item("nodes", static_cast<std::size_t>(unreached - hierarchy.rigNode.begin())));
  return hierarchy;
}

void buildCameras(const Document& document, Diagnostics& diagnostics, const Hierarchy& hierarchy, Model& model) {
  constexpr double kLargest = 1e30;
  const auto cameraOf = [&](std::size_t node) {
    return document.nodes[static_cast<std::size_t>(hierarchy.fileNode[node])].camera;
  };
  std::vector<std::size_t> nodes;  // in the order of the file's cameras
  for (std::size_t n = 0; n < hierarchy.inScene; ++n)
    if (cameraOf(n) != -1) nodes.push_back(n);
  std::stable_sort(nodes.begin(), nodes.end(), [&](std::size_t a, std::size_t b) { return cameraOf(a) < cameraOf(b); });
  for (const std::size_t n : nodes) {
    const int fileNode = hierarchy.fileNode[n], index = cameraOf(n);
    const std::string where = item("nodes", static_cast<std::size_t>(fileNode));
    const CameraInfo& source = get(document.cameras, index, "cameras", diagnostics, where);
    const std::string place = item("cameras", static_cast<std::size_t>(index));
    Camera camera;
    camera.name = source.name.empty() ? nodeName(document, fileNode) : source.name;
    if (source.perspective)
      camera.verticalFov = ranged(source.yfov, 0.001, 3.14, "yfov", diagnostics, place);
    else
      camera.parallelHeight = 2 * ranged(std::abs(source.ymag), 1e-30, kLargest, "ymag", diagnostics, place);
    camera.nearPlane = ranged(source.znear, 0, kLargest, "znear", diagnostics, place);
    camera.farPlane = ranged(source.zfar, 0, kLargest, "zfar", diagnostics, place);
    if (camera.farPlane != 0 && camera.farPlane <= camera.nearPlane) {
      diagnostics.warn("clipping planes in the wrong order were ignored: " + place);
      camera.nearPlane = camera.farPlane = 0;
    }
    model.scene.cameras.push_back(camera);
    model.rig.cameraNodes.push_back(static_cast<int>(n));
  }
}

void buildLights(const Document& document, Diagnostics& diagnostics, const Hierarchy& hierarchy, Model& model) {
  constexpr double kLargest = 1e15;
  for (std::size_t n = 0; n < hierarchy.inScene; ++n) {
    const auto fileNode = static_cast<std::size_t>(hierarchy.fileNode[n]);
    const int index = document.nodes[fileNode].light;
    if (index == -1) continue;
    const LightInfo& source =
        get(document.lights, index, "KHR_lights_punctual.lights", diagnostics, item("nodes", fileNode));
    const std::string place = item("KHR_lights_punctual.lights", static_cast<std::size_t>(index));
    Light light;
    if (source.type == "point")
      light.type = LightType::point;
    else if (source.type == "spot")
      light.type = LightType::spot;
    else if (source.type != "directional")
      diagnostics.fail("has the unknown type \"" + source.type.substr(0, 40) + "\"", place);
    if (!source.color.empty() && source.color.size() != 3) diagnostics.fail("has a color that is not RGB", place);
    for (std::size_t c = 0; c < source.color.size(); ++c)
      light.color[static_cast<int>(c)] = ranged(source.color[c], 0, kLargest, "color", diagnostics, place);
    light.intensity = ranged(source.intensity, 0, kLargest, "intensity", diagnostics, place);
    light.range = ranged(source.range, 0, kLargest, "range", diagnostics, place);
    if (light.type == LightType::spot) {
      light.outerConeAngle =
          ranged(source.outerConeAngle, 1e-3, glm::half_pi<double>(), "outerConeAngle", diagnostics, place);
      light.innerConeAngle = ranged(source.innerConeAngle, 0, static_cast<double>(light.outerConeAngle),
                                    "innerConeAngle", diagnostics, place);
    }
    model.scene.lights.push_back(light);
    model.rig.lightNodes.push_back(static_cast<int>(n));
  }
}

}  // namespace halfsilver::gltf
