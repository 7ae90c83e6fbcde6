#include <halfsilver/scene_core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

#include "scene/longest_side.h"
#include "scene/vertex_ranges.h"

namespace halfsilver {
namespace {

constexpr float kWorthwhile = 4;
// Of the longest side of a posed part's box, by which it grows at least.
constexpr float kSlack = 0.125f;

Bounds boundsOf(const Scene& scene, const Triangle& triangle) {
  Bounds bounds;
  for (const std::uint32_t vertex : triangle.vertices) bounds.add(scene.vertices[vertex].position);
  return bounds;
}

bool reachesBeyond(const Bounds& inner, const Bounds& outer) {
  return glm::any(glm::lessThan(inner.low, outer.low)) || glm::any(glm::greaterThan(inner.high, outer.high));
}

// The box, grown by steps of a size that doubles from kSlack on, until it holds the other one.
Bounds grown(const Bounds& own, const Bounds& other) {
  Bounds result = own;
  result.add(other);
  const float step = kSlack * longestSide(own);
  if (own.empty() || !(step > 0)) return result;
  const auto stepped = [step](float beyond) {
    return beyond > 0 ? step * std::exp2(std::max(0.0f, std::ceil(std::log2(beyond / step)))) : 0;
  };
  for (int axis = 0; axis < 3; ++axis) {
    result.low[axis] = std::min(result.low[axis], own.low[axis] - stepped(own.low[axis] - other.low[axis]));
    result.high[axis] = std::max(result.high[axis], own.high[axis] + stepped(other.high[axis] - own.high[axis]));
  }
  return result;
}

std::span<const Triangle> trianglesOf(const Scene& scene, std::size_t block) {
  const std::size_t first = block * SceneExtents::kBlockTriangles;
  return std::span(scene.triangles)
      .subspan(first, std::min(SceneExtents::kBlockTriangles, scene.triangles.size() - first));
}

}  // namespace

std::optional<std::size_t> partOf(std::span<const PosedPart> posed, std::uint32_t triangle) {
  const auto part = std::partition_point(posed.begin(), posed.end(), [triangle](const PosedPart& each) {
    return each.triangles.first + each.triangles.count <= triangle;
  });
  if (part == posed.end() || part->triangles.first > triangle) return std::nullopt;
  return static_cast<std::size_t>(part - posed.begin());
}

SceneExtents::SceneExtents(const Scene& scene, std::vector<PosedPart> posed)
    : posed_(std::move(posed)), blocks_((scene.triangles.size() + kBlockTriangles - 1) / kBlockTriangles) {
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
  for (PosedPart& part : posed_)
    for (std::uint32_t t = 0; t < part.triangles.count; ++t)
      part.bounds.add(boundsOf(scene, scene.triangles[part.triangles.first + t]));
  held_.reserve(posed_.size());
  for (const PosedPart& part : posed_) held_.push_back(part.bounds);
  combine(scene);
}

void SceneExtents::hold(std::span<const Bounds> boxes) {
  for (std::size_t part = 0; part < posed_.size(); ++part)
    if (!boxes[part].empty()) held_[part] = grown(posed_[part].bounds, boxes[part]);
  grow();
}

void SceneExtents::grow() {
  bounds_ = usual_;
  core_.bounds = usualCore_;
  for (const Bounds& held : held_) {
    bounds_.add(held);
    core_.bounds.add(held);  // triangles that reach beyond it no more may still be called outer ones
  }
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

// Calls visit(number, bounds) for each triangle of the block that is not posed.
template <class Visit>
void SceneExtents::forEachStill(const Scene& scene, std::size_t block, const Visit& visit) const {
  auto number = static_cast<std::uint32_t>(block * kBlockTriangles);
  for (const Triangle& triangle : trianglesOf(scene, block)) {
    if (!partOf(posed_, number)) visit(number, boundsOf(scene, triangle));
    ++number;
  }
}

void SceneExtents::measure(const Scene& scene, std::size_t block) {
  Block& b = blocks_[block];
  b.bounds = Bounds();
  b.largest = 0;
  forEachStill(scene, block, [&](std::uint32_t, const Bounds& bounds) {
    b.bounds.add(bounds);
    b.largest = std::max(b.largest, longestSide(bounds));
  });
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
    forEachStill(scene, *block, [&](std::uint32_t, const Bounds& bounds) {
      largest.push(longestSide(bounds));
      if (largest.size() > kSizes) largest.pop();
    });
  }
  return largest.size() < kSizes ? 0 : largest.top();  // all that are not posed may go
}

void SceneExtents::combine(const Scene& scene) {
  Bounds inner;
  for (const PosedPart& part : posed_) inner.add(part.bounds);
  usual_ = inner;
  for (const Block& block : blocks_) usual_.add(block.bounds);
  usualCore_ = usual_;
  core_.outer.clear();
  findOuter(scene, inner);
  grow();
}

// The core without the largest triangles, if that is much smaller; `inner`: of what is posed.
void SceneExtents::findOuter(const Scene& scene, Bounds inner) {
  if (scene.triangles.size() <= kMaxOuterTriangles) return;

  const float limit = largestThatStays(scene);
  std::vector<std::uint32_t> large;
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    if (blocks_[block].largest <= limit) {
      inner.add(blocks_[block].bounds);
      continue;
    }
    forEachStill(scene, block, [&](std::uint32_t number, const Bounds& bounds) {
      if (longestSide(bounds) > limit)
        large.push_back(number);
      else
        inner.add(bounds);
    });
  }
  if (kWorthwhile * longestSide(inner) > longestSide(usual_)) return;
  usualCore_ = inner;
  std::erase_if(large, [&](std::uint32_t t) { return !reachesBeyond(boundsOf(scene, scene.triangles[t]), inner); });
  core_.outer = std::move(large);
}

}  // namespace halfsilver
