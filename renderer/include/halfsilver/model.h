#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include <halfsilver/scene.h>

// A loaded scene and what can move in it. The rig contains the node hierarchy in double precision and the undeformed
// geometry; pose() (pose.h) writes world-space vertices into the scene.
namespace halfsilver {

struct Node {
  std::string name;
  int parent = -1;  // always smaller than the node's own index
  glm::dvec3 translation{0};
  glm::dquat rotation{1, 0, 0, 0};
  glm::dvec3 scale{1};
  glm::dmat4 matrix{1};  // used instead of the three above if hasMatrix
  bool hasMatrix = false;
  std::vector<float> weights;  // morph weights at rest
};

// One glTF primitive placed by one node: a range of the flattened scene.
struct Instance {
  int node = -1;
  int mesh = -1;       // glTF mesh index, for reports
  int primitive = -1;  // within the mesh
  int skin = -1;
  std::uint32_t firstVertex = 0, vertexCount = 0;
  std::uint32_t firstTriangle = 0, triangleCount = 0;
  std::vector<Vertex> rest;  // local space; positions absolute
  struct MorphTarget {
    std::vector<glm::vec3> positions, normals, tangents;  // empty or one per vertex
  };
  std::vector<MorphTarget> targets;
  std::uint32_t jointSets = 1;     // sets of four joints that each vertex has, one after the other
  std::vector<glm::uvec4> joints;  // empty or jointSets per vertex
  std::vector<glm::vec4> weights;  // as many; those of a vertex have the sum 1
  bool flatNormals = false;        // vertices 3k .. 3k + 2 are one triangle, whose normal follows its deformed corners
  bool turned = false;             // its triangles wind the other way round than the file's, since it is mirrored
};

struct Skin {
  std::vector<int> joints;              // nodes
  std::vector<glm::dmat4> inverseBind;  // one per joint
};

enum class Interpolation { linear, step, cubicSpline };
enum class AnimatedProperty { translation, rotation, scale, weights };

struct Channel {
  int node = -1;
  AnimatedProperty property = AnimatedProperty::translation;
  Interpolation interpolation = Interpolation::linear;
  std::vector<float> times;   // seconds, increasing
  std::vector<float> values;  // as glTF lays them out (cubic: in-tangent, value, out-tangent)
};

struct Animation {
  std::string name;
  float duration = 0;  // seconds
  std::vector<Channel> channels;
};

struct Rig {
  std::vector<Node> nodes;
  std::vector<Instance> instances;
  std::vector<Skin> skins;
  std::vector<Animation> animations;
  // The node of each light and camera that is attached to one: index into Scene::lights or Scene::cameras -> node.
  std::vector<int> lightNodes, cameraNodes;
};

struct DropCounts {
  std::uint64_t degenerate = 0;  // zero area in the rest pose
  std::uint64_t nonFinite = 0;   // a vertex is NaN or infinite
};

// Where a range of the flattened triangles comes from, for reports. Degenerate triangles are not counted.
struct Part {
  std::string node, mesh;  // names, or "node 3", "mesh 1" if the file gives none
  int primitive = 0;       // within the mesh
  std::uint32_t firstTriangle = 0, triangleCount = 0;
  std::uint32_t material = 0;
};

struct Model {
  Scene scene;              // at rest
  Rig rig;                  // without instances if nothing can move
  std::vector<Part> parts;  // in the order of the triangles
  DropCounts dropped;
  std::vector<std::string> variants;  // names of the material variants that a loader can choose from
  std::vector<std::string> warnings;  // one line each
};

struct VertexRange {
  std::uint32_t first = 0, count = 0;
};

struct TriangleRange {
  std::uint32_t first = 0, count = 0;
};

}  // namespace halfsilver
