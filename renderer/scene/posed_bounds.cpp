#include "scene/posed_bounds.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "scene/pose.h"
#include "scene/rig_check.h"

namespace halfsilver {
namespace {

constexpr double kLargestFloat = 0.5 * static_cast<double>(std::numeric_limits<float>::max());
constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Sums of weights and of floats round.
constexpr double kRounding = 1e-5;
// Of the volume that a matrix makes of a cube, to that of a box with edges as long.
constexpr double kFlat = 1e-3;
// Beyond these lengths of a matrix' columns products of three leave the range of floats.
constexpr double kShortest = 1e-10, kLongest = 1e10;

// Of an animation, for its bounds. A smooth path leaves the chord of a step by far less than this part of it.
constexpr int kSamples = 32;
constexpr double kBeyondStep = 0.125;
// Of all nodes together, for the time that loading may take.
constexpr std::size_t kMaxSampledNodes = 1 << 20;

bool isFlat(const glm::dmat3& linear) {
  double lengths = 1;
  for (int column = 0; column < 3; ++column) {
    const double length = glm::length(linear[column]);
    if (length == 0) return false;
    if (length < kShortest || length > kLongest) return true;
    lengths *= length;
  }
  return std::abs(glm::determinant(linear)) < kFlat * lengths;
}

// Of all animations, each sampled over its time.
class Sweeps {
 public:
  explicit Sweeps(const Model& model) : model_(model), bounds_(model.rig.instances.size()) {
    for (const Instance& instance : model.rig.instances) shapes_.emplace_back(model.rig, instance);
  }

  std::vector<Bounds> run() {
    const Rig& rig = model_.rig;
    visit({});
    std::vector<std::vector<int>> played = {compatibleAnimations(rig)};
    for (std::size_t a = 0; a < rig.animations.size(); ++a)
      if (played.front() != std::vector<int>{static_cast<int>(a)}) played.push_back({static_cast<int>(a)});
    const std::size_t poses = std::max<std::size_t>(1, kMaxSampledNodes / std::max<std::size_t>(1, rig.nodes.size()));
    const auto samples = static_cast<int>(std::clamp<std::size_t>(poses / played.size(), 4, kSamples));
    for (const std::vector<int>& animations : played) sweep(animations, samples);
    return std::move(bounds_);
  }

 private:
  void sweep(const std::vector<int>& animations, int samples) {
    double duration = 0;
    for (const int a : animations)
      duration = std::max(duration, static_cast<double>(model_.rig.animations[static_cast<std::size_t>(a)].duration));
    if (animations.empty() || !(duration > 0)) return;
    before_.assign(bounds_.size(), Bounds());
    std::vector<float> steps(bounds_.size());
    for (int i = 0; i <= samples; ++i) {
      const std::vector<Bounds> now = visit(playTogether(animations, duration * i / samples));
      for (std::size_t k = 0; k < now.size(); ++k)
        if (i > 0 && !now[k].empty() && !before_[k].empty())
          for (int axis = 0; axis < 3; ++axis)
            steps[k] = std::max({steps[k], std::abs(now[k].low[axis] - before_[k].low[axis]),
                                 std::abs(now[k].high[axis] - before_[k].high[axis])});
      before_ = now;
    }
    for (std::size_t k = 0; k < bounds_.size(); ++k) {
      if (bounds_[k].empty()) continue;
      const glm::vec3 margin(static_cast<float>(kBeyondStep) * steps[k]);
      bounds_[k].low -= margin;
      bounds_[k].high += margin;
    }
  }

  std::vector<Bounds> visit(const std::vector<Playing>& playing) {
    const Rig& rig = model_.rig;
    const PoseState state = evaluate(rig, playing);
    std::vector<Bounds> boxes(bounds_.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const Instance& instance = rig.instances[i];
      const InstanceShape::Placed placed =
          shapes_[i].at(placingMatrices(rig, instance, state), state.weights[static_cast<std::size_t>(instance.node)],
                        model_.scene.origin);
      if (!placed.finite) continue;
      boxes[i] = placed.bounds;
      bounds_[i].add(placed.bounds);
    }
    return boxes;
  }

  const Model& model_;
  std::vector<InstanceShape> shapes_;
  std::vector<Bounds> bounds_, before_;
};

}  // namespace

InstanceShape::InstanceShape(const Rig& rig, const Instance& instance) {
  Bounds rest;
  for (const Vertex& vertex : instance.rest) rest.add(vertex.position);
  center_ = rest.center();
  const std::size_t matrices = matrixShares(rig, instance).size();
  const bool skinned = instance.skin >= 0 && !instance.joints.empty();
  const std::size_t sets = skinned ? instance.jointSets : 0;
  boxes_.assign(matrices, {glm::dvec3(kInfinity), glm::dvec3(-kInfinity)});
  for (std::size_t i = 0; i < instance.rest.size(); ++i) {
    const glm::dvec3 point = glm::dvec3(instance.rest[i].position) - glm::dvec3(center_);
    const auto add = [&](Box& box) {
      box.low = glm::min(box.low, point);
      box.high = glm::max(box.high, point);
    };
    if (!skinned) add(boxes_.front());
    for (std::size_t set = i * sets; set < (i + 1) * sets; ++set)
      for (int k = 0; k < 4; ++k)
        if (instance.weights[set][k] != 0) add(boxes_[instance.joints[set][k]]);
  }
  for (const Instance::MorphTarget& target : instance.targets) {
    Box& box = deltas_.emplace_back(Box{glm::dvec3(0), glm::dvec3(0)});
    for (const glm::vec3& delta : target.positions) {
      box.low = glm::min(box.low, glm::dvec3(delta));
      box.high = glm::max(box.high, glm::dvec3(delta));
    }
  }
}

InstanceShape::Placed InstanceShape::at(std::span<const glm::dmat4> matrices, std::span<const double> weights,
                                        const glm::dvec3& origin) const {
  Box morph{glm::dvec3(0), glm::dvec3(0)};
  glm::dvec3 morphReach(0);
  for (std::size_t k = 0; k < std::min(weights.size(), deltas_.size()); ++k) {
    const glm::dvec3 a = weights[k] * deltas_[k].low, b = weights[k] * deltas_[k].high;
    morph.low += glm::min(a, b);
    morph.high += glm::max(a, b);
    morphReach += glm::max(glm::abs(a), glm::abs(b));
  }
  Placed placed;
  glm::dvec3 low(kInfinity), high(-kInfinity);
  for (std::size_t j = 0; j < matrices.size(); ++j) {
    const Box& box = boxes_[j];
    if (box.low.x > box.high.x) continue;
    const glm::dmat3 linear(matrices[j]);
    const glm::dmat3 absolute(glm::abs(linear[0]), glm::abs(linear[1]), glm::abs(linear[2]));
    const glm::dvec3 first = box.low + morph.low, last = box.high + morph.high;
    const glm::dvec3 offset = glm::dvec3(matrices[j] * glm::dvec4(glm::dvec3(center_), 1)) - origin;
    const glm::dvec3 middle = offset + linear * (0.5 * (first + last)), half = absolute * (0.5 * (last - first));
    low = glm::min(low, middle - half);
    high = glm::max(high, middle + half);
    const glm::dvec3 reach = absolute * (glm::max(glm::abs(box.low), glm::abs(box.high)) + morphReach);
    for (int axis = 0; axis < 3; ++axis) {
      const double term = reach[axis] + std::abs(offset[axis]);
      placed.largest = std::max(placed.largest, term);
      placed.finite &= term <= kLargestFloat;  // not for NaN
    }
    placed.flat |= isFlat(linear);
  }
  if (low.x > high.x) return placed;
  const glm::dvec3 margin(kRounding * std::max({high.x - low.x, high.y - low.y, high.z - low.z}));
  placed.bounds = {glm::vec3(low - margin), glm::vec3(high + margin)};
  return placed;
}

AnimatedBounds animatedBounds(const Model& model) {
  checkRig(model);
  AnimatedBounds bounds;
  if (!model.rig.instances.empty()) bounds.instances = Sweeps(model).run();
  bounds.all = model.scene.bounds();
  for (const Bounds& instance : bounds.instances) bounds.all.add(instance);
  return bounds;
}

}  // namespace halfsilver
