#include "frame/gpu_rig.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include <halfsilver/error.h>
#include "frame/gpu_scene.h"
#include "frame/pose_structs.h"
#include "scene/pose.h"

namespace halfsilver {
namespace {

// A posed vertex is a sum of at most so many rounded terms, each below InstanceShape::Placed::largest, and of one for
// each morph target that has a weight.
constexpr double kRoundedTerms = 8;

double roundedTerms(const Instance& instance, std::span<const double> weights) {
  const auto used = weights.first(std::min(weights.size(), instance.targets.size()));
  return kRoundedTerms + 4.0 * (instance.jointSets - 1) + static_cast<double>(used.size()) -
         static_cast<double>(std::count(used.begin(), used.end(), 0));
}

// What the GPU keeps of all instances.
struct RestData {
  std::vector<shared::RestVertex> vertices;
  std::vector<shared::JointInfluences> influences;
  std::vector<float> deltas;

  bool fits(const Instance& instance, std::size_t limit) const {
    const std::size_t count = instance.rest.size();
    return (vertices.size() + count) * sizeof(shared::RestVertex) <= limit &&
           (influences.size() + count * instance.jointSets) * sizeof(shared::JointInfluences) <= limit &&
           (deltas.size() + instance.targets.size() * count * MORPH_FLOATS) * sizeof(float) <= limit;
  }
  void addVertices(const Instance& instance, const glm::vec3& center) {
    for (const Vertex& vertex : instance.rest)
      vertices.push_back({vertex.position - center, vertex.tangent.w, vertex.normal, 0, glm::vec3(vertex.tangent), 0});
  }
  void addInfluences(const Instance& instance) {
    for (std::size_t i = 0; i < instance.joints.size(); ++i) {
      shared::JointInfluences& influence = influences.emplace_back();
      for (int k = 0; k < 4; ++k) {
        influence.joints[k] = instance.joints[i][k];
        influence.weights[k] = instance.weights[i][k];
      }
    }
  }
  void addDeltas(const Instance::MorphTarget& target, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      for (const auto* part : {&target.positions, &target.normals, &target.tangents})
        for (int axis = 0; axis < 3; ++axis) deltas.push_back(part->empty() ? 0.0f : (*part)[i][axis]);
  }
};

// What has an invocation of its own: triangles with flat normals, else vertices.
std::uint32_t itemsOf(const Instance& instance) {
  return instance.flatNormals ? instance.vertexCount / 3 : instance.vertexCount;
}

// From rest positions around the center to positions relative to the origin.
shared::PoseMatrix relative(const glm::dmat4& matrix, const glm::dvec3& center, const glm::dvec3& origin) {
  const glm::dvec3 offset = glm::dvec3(matrix * glm::dvec4(center, 1)) - origin;
  shared::PoseMatrix result;
  for (int row = 0; row < 3; ++row) result.rows[row] = {matrix[0][row], matrix[1][row], matrix[2][row], offset[row]};
  return result;
}

void addRange(std::vector<VertexRange>& ranges, const Instance& instance) {
  if (!ranges.empty() && ranges.back().first + ranges.back().count == instance.firstVertex)
    ranges.back().count += instance.vertexCount;
  else
    ranges.push_back({instance.firstVertex, instance.vertexCount});
}

}  // namespace

GpuRig::GpuRig(const gl::Api& api, const Model& model) : rig_(model.rig), origin_(model.scene.origin) {
  state_ = evaluate(rig_, {});
  for (const int node : rig_.lightNodes)
    restNodes_.push_back(node < 0 ? glm::dmat4(1) : state_.world[static_cast<std::size_t>(node)]);
  lightNodes_ = restNodes_;
  if (rig_.instances.empty()) return;
  RestData data;
  std::size_t groups = 0, matrices = 0, weights = 0;
  for (const Instance& instance : rig_.instances) {
    Part& part =
        parts_.emplace_back(Part{.shape = InstanceShape(rig_, instance), .shares = matrixShares(rig_, instance)});
    part.fits = data.fits(instance, static_cast<std::size_t>(api.limits.storageBlockBytes));
    if (!part.fits) continue;
    part.rest = static_cast<std::uint32_t>(data.vertices.size());
    data.addVertices(instance, part.shape.center());
    part.influences = static_cast<std::uint32_t>(data.influences.size());
    if (instance.skin >= 0) data.addInfluences(instance);
    for (const Instance::MorphTarget& target : instance.targets) {
      part.deltas.push_back(static_cast<std::uint32_t>(data.deltas.size()));
      data.addDeltas(target, instance.rest.size());
    }
    groups += (itemsOf(instance) + POSE_GROUP - 1) / POSE_GROUP;
    matrices += part.shares.size();
    weights += instance.targets.size();
  }
  const auto room = [](std::size_t count) { return std::max<std::size_t>(1, count); };
  rest_ = gl::makeBuffer(api, std::span<const shared::RestVertex>(data.vertices), "rest vertices");
  influences_ = gl::makeBuffer(api, std::span<const shared::JointInfluences>(data.influences), "joint influences");
  deltas_ = gl::makeBuffer(api, std::span<const float>(data.deltas), "morph deltas");
  weights_ = gl::Buffer(api, room(weights) * sizeof(shared::MorphWeight), "morph weights");
  matrices_ = gl::Buffer(api, room(matrices) * sizeof(shared::PoseMatrix), "pose matrices");
  groups_ = gl::Buffer(api, room(groups) * sizeof(shared::PoseGroup), "pose groups");
}

std::vector<GpuRig::Next> GpuRig::next(const PoseState& state) const {
  if (state.world.size() != rig_.nodes.size() || state.weights.size() != rig_.nodes.size())
    throw Error(ErrorKind::usage, "the pose has " + std::to_string(state.world.size()) + " nodes, the model " +
                                      std::to_string(rig_.nodes.size()));
  std::vector<Next> all(parts_.size());
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Instance& instance = rig_.instances[i];
    Next& next = all[i];
    next.matrices = placingMatrices(rig_, instance, state);
    next.weights = state.weights[static_cast<std::size_t>(instance.node)];
    next.moves = next.matrices != parts_[i].matrices || next.weights != parts_[i].weights;
    if (!next.moves) continue;
    next.placed = parts_[i].shape.at(next.matrices, next.weights, origin_);
    if (!next.placed.finite)
      throw Error(ErrorKind::badInput,
                  "an animation moves the scene out of the range of floats: node " + std::to_string(instance.node));
  }
  return all;
}

void GpuRig::take(const PoseState& state, GpuScene& scene, Change& change) {
  std::vector<Next> all = next(state);
  PoseState taken = state;
  std::vector<Bounds> boxes;
  for (const Next& each : all) boxes.push_back(each.moves ? each.placed.bounds : Bounds());
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Instance& instance = rig_.instances[i];
    if (!all[i].moves) continue;
    if (instance.vertexCount > 0) addRange(change.scene.moved, instance);
    if (mirrored(all[i].matrices, parts_[i].shares) != instance.turned && instance.triangleCount > 0)
      change.scene.turned.push_back({instance.firstTriangle, instance.triangleCount});
  }
  // What is not done to its end has no pose, so that the next one does it again.
  for (std::size_t i = 0; i < parts_.size(); ++i)
    if (all[i].moves) parts_[i].forgetPose();
  state_ = std::move(taken);
  scene.extents.hold(boxes);
  change.touched = scene.clusters.follow(boxes);
  // That of a pose alone, whatever poses came before.
  const double tolerance = kTolerance * static_cast<double>(scene.extents.usual().diagonal());
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    Instance& instance = rig_.instances[i];
    Part& part = parts_[i];
    Next& next = all[i];
    if (!next.moves) continue;
    const bool turned = mirrored(next.matrices, part.shares);
    if (turned != instance.turned && instance.triangleCount > 0)
      turnTriangles(scene, {instance.firstTriangle, instance.triangleCount});
    instance.turned = turned;
    const double error = roundedTerms(instance, next.weights) * next.placed.largest *
                         static_cast<double>(std::numeric_limits<float>::epsilon());
    const bool onGpu = part.fits && !next.placed.flat && error <= tolerance;
    if (!onGpu) placeOnCpu(i, scene);
    part.matrices = std::move(next.matrices);
    part.weights = std::move(next.weights);
    part.waiting = onGpu;
  }
}

bool GpuRig::waiting() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const Part& part) { return part.waiting; });
}

void GpuRig::placeOnCpu(std::size_t part, GpuScene& scene) const {
  const Instance& instance = rig_.instances[part];
  std::vector<Vertex> vertices(instance.rest.size());
  place(rig_, instance, state_, origin_, vertices);
  writeVertices(scene, vertices, instance.firstVertex);
}

void GpuRig::placeOnCpu(GpuScene& scene) {
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (parts_[i].waiting) placeOnCpu(i, scene);
    parts_[i].waiting = false;
  }
}

void GpuRig::placed() {
  for (Part& part : parts_) part.waiting = false;
}

bool GpuRig::follow(const PoseState& state, std::span<Light> lights) {
  bool moved = false;
  for (std::size_t i = 0; i < std::min(lights.size(), rig_.lightNodes.size()); ++i) {
    if (rig_.lightNodes[i] < 0) continue;
    const glm::dmat4& node = state.world[static_cast<std::size_t>(rig_.lightNodes[i])];
    if (std::exchange(lightNodes_[i], node) == node) continue;
    halfsilver::follow(lights[i], node, origin_);
    moved = true;
  }
  return moved;
}

void GpuRig::putInPlace(std::span<Light> lights) const {
  for (std::size_t i = 0; i < std::min(lights.size(), restNodes_.size()); ++i)
    if (lightNodes_[i] != restNodes_[i]) halfsilver::follow(lights[i], lightNodes_[i], origin_);
}

std::vector<GpuRig::Batch> GpuRig::upload() {
  std::array<std::vector<shared::PoseGroup>, Batch::kKinds> groups;
  std::array<Batch, Batch::kKinds> kinds;
  std::vector<shared::PoseMatrix> matrices;
  std::vector<shared::MorphWeight> weights;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Part& part = parts_[i];
    if (!part.waiting) continue;
    const Instance& instance = rig_.instances[i];
    const Batch batch{instance.skin >= 0, !instance.targets.empty(), instance.flatNormals};
    kinds[batch.kind()] = batch;
    shared::PoseGroup group{};
    group.vertex = instance.firstVertex;
    group.rest = part.rest;
    group.influences = part.influences;
    group.jointSets = instance.jointSets;
    group.matrix = static_cast<std::uint32_t>(matrices.size());
    group.morphWeights = static_cast<std::uint32_t>(weights.size());
    group.flags = instance.turned ? POSE_TURNED : 0;
    for (const glm::dmat4& matrix : part.matrices) matrices.push_back(relative(matrix, part.shape.center(), origin_));
    for (std::size_t k = 0; k < std::min(part.weights.size(), part.deltas.size()); ++k)
      if (part.weights[k] != 0) weights.push_back({part.deltas[k], static_cast<float>(part.weights[k])});
    group.morphCount = static_cast<std::uint32_t>(weights.size()) - group.morphWeights;
    for (const std::uint32_t items = itemsOf(instance); group.first < items; group.first += POSE_GROUP) {
      group.count = std::min<std::uint32_t>(POSE_GROUP, items - group.first);
      groups[batch.kind()].push_back(group);
    }
  }
  std::vector<shared::PoseGroup> all;
  std::vector<Batch> batches;
  for (std::size_t kind = 0; kind < groups.size(); ++kind) {
    if (groups[kind].empty()) continue;
    Batch& batch = batches.emplace_back(kinds[kind]);
    batch.firstGroup = static_cast<std::uint32_t>(all.size());
    batch.groupCount = static_cast<std::uint32_t>(groups[kind].size());
    all.insert(all.end(), groups[kind].begin(), groups[kind].end());
  }
  groups_.write(std::span<const shared::PoseGroup>(all));
  matrices_.write(std::span<const shared::PoseMatrix>(matrices));
  weights_.write(std::span<const shared::MorphWeight>(weights));
  return batches;
}

void GpuRig::bind() const {
  rest_.bindStorage(SSBO_REST);
  influences_.bindStorage(SSBO_INFLUENCES);
  deltas_.bindStorage(SSBO_MORPH_DELTAS);
  weights_.bindStorage(SSBO_MORPH_WEIGHTS);
  matrices_.bindStorage(SSBO_POSE_MATRICES);
  groups_.bindStorage(SSBO_POSE_GROUPS);
}

std::size_t GpuRig::bytes() const {
  return rest_.bytes() + influences_.bytes() + deltas_.bytes() + weights_.bytes() + matrices_.bytes() + groups_.bytes();
}

std::vector<PosedPart> posedParts(const Model& model, std::span<const Bounds> bounds) {
  std::vector<PosedPart> parts;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const Instance& instance = model.rig.instances[i];
    parts.push_back(
        {{instance.firstVertex, instance.vertexCount}, {instance.firstTriangle, instance.triangleCount}, bounds[i]});
  }
  return parts;
}

}  // namespace halfsilver
