#include <halfsilver/scene_core.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>

#include "scene/vertex_ranges.h"

namespace halfsilver {
namespace {

constexpr float kWorthwhile = 4;

// 0 for an empty box, and never NaN.
float longestSide(const Bounds& bounds) {
  const glm::vec3 extent = bounds.extent();
  float longest = 0;
  for (int axis = 0; axis < 3; ++axis) longest = std::max(longest, extent[axis]);
  return longest;
}

Bounds boundsOf(const Scene& scene, const Triangle& triangle) {
  Bounds bounds;
  for (const std::uint32_t vertex : triangle.vertices) bounds.add(scene.vertices[vertex].position);
  return bounds;
}

void add(Bounds& bounds, const Bounds& other) {
  bounds.low = glm::min(bounds.low, other.low);
  bounds.high = glm::max(bounds.high, other.high);
}

bool reachesBeyond(const Bounds& inner, const Bounds& outer) {
  return glm::any(glm::lessThan(inner.low, outer.low)) || glm::any(glm::greaterThan(inner.high, outer.high));
}

std::span<const Triangle> trianglesOf(const Scene& scene, std::size_t block) {
  const std::size_t first = block * SceneExtents::kBlockTriangles;
  return std::span(scene.triangles)
      .subspan(first, std::min(SceneExtents::kBlockTriangles, scene.triangles.size() - first));
}

}  // namespace

SceneExtents::SceneExtents(const Scene& scene)
    : blocks_((scene.triangles.size() + kBlockTriangles - 1) / kBlockTriangles) {
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    Block& b = blocks_[block];
    b.firstVertex = std::numeric_limits<std::uint32_t>::max();
    for (const Triangle& triangle : trianglesOf(scene, block))
      for (const std::uint32_t vertex : triangle.vertices) {
        b.firstVertex = std::min(b.firstVertex, vertex);
        b.lastVertex = std::max(b.lastVertex, vertex);
      }
    measure(scene, block);
  }
  combine(scene);
}

std::vector<std::uint32_t> SceneExtents::blocksUsing(std::span<const VertexRange> merged) const {
  std::vector<std::uint32_t> blocks;
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    const Block& b = blocks_[block];
    if (touchesRange(merged, b.firstVertex, b.lastVertex)) blocks.push_back(static_cast<std::uint32_t>(block));
  }
  return blocks;
}

std::size_t SceneExtents::update(const Scene& scene, std::span<const VertexRange> moved) {
  const std::vector<std::uint32_t> blocks = blocksUsing(mergeRanges(moved));
  for (const std::uint32_t block : blocks) measure(scene, block);
  if (!blocks.empty()) combine(scene);
  return blocks.size();
}

void SceneExtents::measure(const Scene& scene, std::size_t block) {
  Block& b = blocks_[block];
  b.bounds = Bounds();
  b.largest = 0;
  for (const Triangle& triangle : trianglesOf(scene, block)) {
    const Bounds bounds = boundsOf(scene, triangle);
    add(b.bounds, bounds);
    b.largest = std::max(b.largest, longestSide(bounds));
  }
}

// The size of the largest triangle behind the kMaxOuterTriangles that may go. The blocks with the largest triangles
// hold them all.
float SceneExtents::largestThatStays(const Scene& scene) const {
  constexpr std::size_t kSizes = kMaxOuterTriangles + 1;
  std::vector<std::size_t> order(blocks_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto candidates = order.begin() + static_cast<std::ptrdiff_t>(std::min(kSizes, order.size()));
  std::partial_sort(order.begin(), candidates, order.end(),
                    [this](std::size_t a, std::size_t b) { return blocks_[a].largest > blocks_[b].largest; });
  std::priority_queue<float, std::vector<float>, std::greater<>> largest;
  for (auto block = order.begin(); block != candidates; ++block) {
    if (largest.size() == kSizes && blocks_[*block].largest <= largest.top()) break;
    for (const Triangle& triangle : trianglesOf(scene, *block)) {
      largest.push(longestSide(boundsOf(scene, triangle)));
      if (largest.size() > kSizes) largest.pop();
    }
  }
  return largest.top();
}

void SceneExtents::combine(const Scene& scene) {
  bounds_ = Bounds();
  for (const Block& block : blocks_) add(bounds_, block.bounds);
  core_ = {bounds_, {}};
  if (scene.triangles.size() <= kMaxOuterTriangles) return;

  const float limit = largestThatStays(scene);
  Bounds inner;
  std::vector<std::uint32_t> large;
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    if (blocks_[block].largest <= limit) {
      add(inner, blocks_[block].bounds);
      continue;
    }
    auto number = static_cast<std::uint32_t>(block * kBlockTriangles);
    for (const Triangle& triangle : trianglesOf(scene, block)) {
      const Bounds bounds = boundsOf(scene, triangle);
      if (longestSide(bounds) > limit)
        large.push_back(number);
      else
        add(inner, bounds);
      ++number;
    }
  }
  if (kWorthwhile * longestSide(inner) > longestSide(bounds_)) return;
  core_.bounds = inner;
  std::erase_if(large, [&](std::uint32_t t) { return !reachesBeyond(boundsOf(scene, scene.triangles[t]), inner); });
  core_.outer = std::move(large);
}

}  // namespace halfsilver
