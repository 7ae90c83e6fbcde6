#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include <halfsilver/model.h>

// The parts of pose(); a loader places the rest pose with the same functions.
namespace halfsilver {

struct PoseState {
  std::vector<glm::dmat4> world;             // one per node, world units
  std::vector<std::vector<double>> weights;  // morph weights, one list per node
};

// The rest pose if `animation` < 0 or the rig has no animation. Throws Error (usage) for an unknown animation or a
// time that is not finite.
PoseState evaluate(const Rig& rig, double seconds, int animation);

// Absolute world positions of the instance's vertices.
std::vector<glm::dvec3> worldPositions(const Rig& rig, const Instance& instance, const PoseState& state);

// Writes the instance's vertices relative to `origin`: positions rounded once, normals and tangents unit length.
// `vertices` holds instance.rest.size() elements.
void place(const Rig& rig, const Instance& instance, const PoseState& state, const glm::dvec3& origin,
           std::span<Vertex> vertices);

// Whether the instance's node mirrors it, so that its triangles wind the other way round. A skinned instance does
// not follow its node.
bool mirrored(const Instance& instance, const PoseState& state);

// Cameras look and lights shine along their node's -z; the node's scale changes neither.
void follow(Camera& camera, const glm::dmat4& world, const glm::dvec3& origin);
void follow(Light& light, const glm::dmat4& world, const glm::dvec3& origin);

}  // namespace halfsilver
