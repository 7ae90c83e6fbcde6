#include "passes/shadow_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/longest_side.h"

namespace halfsilver {
namespace {

using glm::vec3;

// What is smaller in the texels of the map of all has maps around the eye, in which it is larger.
constexpr float kFewestTexels = 1, kWantedTexels = 32;
constexpr int kMaxBoxes = 4;      // a light has six maps; the core and the whole scene take two
constexpr float kSteepest = 8;    // size of a box over that of the one in it
constexpr float kStepsOfEye = 8;  // per size of a box

// It grows and moves by steps of a quarter, so that maps are kept while something moves in it.
Bounds smallCore(std::span<const DrawCluster> clusters, float whole) {
  constexpr float kWorthwhile = 16, kSteps = 4;
  Bounds core;
  for (const DrawCluster& cluster : clusters)
    if (kWorthwhile * longestSide(cluster.bounds) <= whole) core.add(cluster.bounds);
  const float size = longestSide(core);
  if (!(size > 0) || kWorthwhile * size > whole) return {};
  const float step = std::exp2(std::floor(std::log2(size / kSteps)));
  return {step * glm::floor(core.low / step), step * glm::ceil(core.high / step)};
}

// The size of the smallest cluster, down to a power of two. A single triangle is no thing of its own.
float smallest(std::span<const DrawCluster> clusters) {
  float least = std::numeric_limits<float>::max();
  for (const DrawCluster& cluster : clusters)
    if (const float size = longestSide(cluster.bounds); cluster.count > 1 && size > 0) least = std::min(least, size);
  return std::exp2(std::floor(std::log2(least)));
}

}  // namespace

ShadowBoxes shadowBoxes(std::span<const DrawCluster> clusters, const Bounds& whole, int resolution, const vec3& eye) {
  ShadowBoxes boxes;
  const float all = longestSide(whole);
  if (!(all > 0)) return boxes;
  boxes.core = smallCore(clusters, all);
  const float outer = boxes.core.empty() ? all : longestSide(boxes.core);
  const float least = smallest(clusters), texels = static_cast<float>(resolution) * least / outer;
  if (!(texels < kFewestTexels)) return boxes;

  const float ratio = kWantedTexels / texels;
  const int count = std::clamp(static_cast<int>(std::ceil(std::log(ratio) / std::log(kSteepest))), 1, kMaxBoxes);
  const float factor = std::min(std::pow(ratio, 1.0f / static_cast<float>(count)), kSteepest);
  const vec3 inside = glm::clamp(eye, whole.low, whole.high);
  for (int i = count; i > 0; --i) {
    const float size = outer * std::pow(factor, static_cast<float>(-i)), step = size / kStepsOfEye;
    const vec3 center = step * glm::floor(inside / step + 0.5f);
    boxes.around.push_back({glm::max(center - 0.5f * size, whole.low), glm::min(center + 0.5f * size, whole.high)});
  }
  return boxes;
}

}  // namespace halfsilver
