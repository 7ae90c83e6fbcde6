#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include <halfsilver/pose.h>

// The parts of pose(); a loader places the rest pose with the same functions.
namespace halfsilver {

// Absolute world positions of the instance's vertices.
std::vector<glm::dvec3> worldPositions(const Rig& rig, const Instance& instance, const PoseState& state);

// Writes the instance's vertices relative to `origin`: positions rounded once, normals and tangents unit length.
// `vertices` holds instance.rest.size() elements; Instance::turned is that of the pose.
void place(const Rig& rig, const Instance& instance, const PoseState& state, const glm::dvec3& origin,
           std::span<Vertex> vertices);

// The matrices that place an instance's vertices, from their rest pose to the world: of its skin's joints or, without a
// skin, of its node alone. A skinned instance does not follow its node.
std::vector<glm::dmat4> placingMatrices(const Rig& rig, const Instance& instance, const PoseState& state);

// What the vertices give each of these, summed.
std::vector<double> matrixShares(const Rig& rig, const Instance& instance);

// Whether the pose mirrors the instance, so that its triangles wind the other way round: by the determinant of its
// node's global transform or, of a skinned instance, of its joints' matrices, each weighted by its share.
bool mirrored(std::span<const glm::dmat4> matrices, std::span<const double> shares);
bool mirrored(const Rig& rig, const Instance& instance, const PoseState& state);

// Cameras look and lights shine along their node's -z; the node's scale changes neither.
void follow(Camera& camera, const glm::dmat4& world, const glm::dvec3& origin);
void follow(Light& light, const glm::dmat4& world, const glm::dvec3& origin);

// Has the lights follow their nodes (-1: none). Returns whether one moved.
bool followLights(std::span<const int> nodes, const PoseState& state, const glm::dvec3& origin,
                  std::span<Light> lights);

}  // namespace halfsilver
