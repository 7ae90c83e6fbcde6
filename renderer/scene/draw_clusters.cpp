#include <halfsilver/draw_clusters.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "scene/longest_side.h"
#include "scene/vertex_ranges.h"

namespace halfsilver {
namespace {

void measure(const Scene& scene, std::span<const std::uint32_t> drawList, DrawCluster& cluster) {
  cluster.bounds = Bounds();
  cluster.firstVertex = std::numeric_limits<std::uint32_t>::max();
  cluster.lastVertex = 0;
  for (const std::uint32_t triangle : drawList.subspan(cluster.first, cluster.count))
    for (const std::uint32_t vertex : scene.triangles[triangle].vertices) {
      cluster.bounds.add(scene.vertices[vertex].position);
      cluster.firstVertex = std::min(cluster.firstVertex, vertex);
      cluster.lastVertex = std::max(cluster.lastVertex, vertex);
    }
}

// The first range that holds a vertex of the triangle, or none of them.
std::optional<std::size_t> rangeOf(std::span<const VertexRange> ranges, const Triangle& triangle) {
  for (const std::uint32_t vertex : triangle.vertices)
    if (const std::size_t range = firstRangeFrom(ranges, vertex);
        range < ranges.size() && ranges[range].first <= vertex)
      return range;
  return std::nullopt;
}

// The cluster in pieces that move with one range each or with none.
std::vector<DrawCluster> split(const Scene& scene, std::span<const std::uint32_t> drawList,
                               std::span<const VertexRange> ranges, const DrawCluster& cluster) {
  std::vector<DrawCluster> pieces;
  std::optional<std::size_t> last;
  for (std::uint32_t i = cluster.first; i < cluster.first + cluster.count; ++i) {
    const std::optional<std::size_t> range = rangeOf(ranges, scene.triangles[drawList[i]]);
    if (pieces.empty() || range != last) {
      DrawCluster& piece = pieces.emplace_back();
      piece.first = i;
      piece.cut = cluster.cut;
      piece.moves = range.has_value();
      last = range;
    }
    ++pieces.back().count;
  }
  return pieces;
}

Bounds boundsOf(const Scene& scene, std::uint32_t triangle) {
  Bounds bounds;
  for (const std::uint32_t vertex : scene.triangles[triangle].vertices) bounds.add(scene.vertices[vertex].position);
  return bounds;
}

// Which triangles of the list are far larger than all others: a sixteenth of the scene. Nothing if they are many.
std::vector<bool> largeTriangles(const Scene& scene, std::span<const std::uint32_t> drawList) {
  constexpr float kShare = 1.0f / 16;
  constexpr std::ptrdiff_t kMost = 64;
  Bounds all;
  for (const std::uint32_t triangle : drawList) all.add(boundsOf(scene, triangle));
  const float limit = kShare * longestSide(all);
  std::vector<bool> large;
  large.reserve(drawList.size());
  for (const std::uint32_t triangle : drawList) large.push_back(longestSide(boundsOf(scene, triangle)) > limit);
  if (std::count(large.begin(), large.end(), true) > kMost) large.assign(drawList.size(), false);
  return large;
}

// A cluster that triangles are added to.
struct Growing {
  Bounds bounds;
  double sides = 0;  // sum of the longest sides of its triangles
  std::uint32_t count = 0;

  void add(const Bounds& triangle) {
    bounds.add(triangle);
    sides += static_cast<double>(longestSide(triangle));
    ++count;
  }
  // Whether the triangle is far from the others, or of quite another size: part of another thing.
  bool isForeign(const Bounds& triangle) const {
    constexpr float kFar = 16, kUnlike = 8;
    const float side = longestSide(triangle), mean = static_cast<float>(sides / count);
    if (!(side > 0) || !(mean > 0)) return false;
    Bounds both = bounds;
    both.add(triangle);
    return longestSide(both) > kFar * std::max(longestSide(bounds), side) || side > kUnlike * mean ||
           kUnlike * side < mean;
  }
};

}  // namespace

DrawClusters::DrawClusters(const Scene& scene, std::vector<std::uint32_t> drawList, std::span<const DrawRange> ranges,
                           std::span<const PosedPart> posed)
    : drawList_(std::move(drawList)) {
  group(scene, ranges, posed, true);
  // An order without neighbors is not one of things; then a few large triangles are kept apart from all others.
  constexpr std::size_t kSeparate = 160;
  if (clusters_.size() > kSeparate + 2 * drawList_.size() / kTriangles) group(scene, ranges, posed, false);
}

void DrawClusters::group(const Scene& scene, std::span<const DrawRange> ranges, std::span<const PosedPart> posed,
                         bool byThing) {
  clusters_.clear();
  const std::vector<bool> large = byThing ? std::vector<bool>(drawList_.size()) : largeTriangles(scene, drawList_);
  for (const DrawRange& range : ranges) {
    const std::uint32_t end = range.first + range.count;
    for (std::uint32_t next = range.first; next < end;) {
      DrawCluster& cluster = clusters_.emplace_back();
      cluster.first = next;
      cluster.cut = range.cut;
      cluster.part = partOf(posed, drawList_[next]);
      Growing growing;
      for (; next < end && growing.count < kTriangles && partOf(posed, drawList_[next]) == cluster.part; ++next) {
        const Bounds triangle = boundsOf(scene, drawList_[next]);
        if (large[next] != large[cluster.first]) break;
        if (byThing && growing.count > 0 && growing.isForeign(triangle)) break;
        growing.add(triangle);
      }
      cluster.count = growing.count;
      measure(scene, drawList_, cluster);
      if (cluster.part) cluster.bounds = posed[*cluster.part].bounds;
    }
  }
}

std::vector<Bounds> DrawClusters::update(const Scene& scene, std::span<const VertexRange> moved) {
  const std::vector<VertexRange> ranges = mergeRanges(moved);
  std::vector<DrawCluster> clusters;
  clusters.reserve(clusters_.size());
  std::vector<Bounds> touched;
  for (const DrawCluster& cluster : clusters_) {
    if (!touchesRange(ranges, cluster.firstVertex, cluster.lastVertex)) {
      clusters.push_back(cluster);
      continue;
    }
    const std::vector<DrawCluster> pieces =
        cluster.moves ? std::vector<DrawCluster>{cluster} : split(scene, drawList_, ranges, cluster);
    const bool moves = std::any_of(pieces.begin(), pieces.end(), [](const DrawCluster& piece) { return piece.moves; });
    if (moves) touched.push_back(cluster.bounds);
    if (moves && !cluster.moves) started_.push_back(cluster.bounds);
    for (DrawCluster piece : pieces) {
      measure(scene, drawList_, piece);
      if (piece.moves) touched.push_back(piece.bounds);
      clusters.push_back(piece);
    }
  }
  clusters_ = std::move(clusters);
  return touched;
}

std::vector<Bounds> DrawClusters::follow(std::span<const Bounds> parts) {
  std::vector<Bounds> touched;
  for (DrawCluster& cluster : clusters_) {
    if (!cluster.part || parts[*cluster.part].empty()) continue;
    if (!std::exchange(cluster.moves, true)) started_.push_back(cluster.bounds);
    touched.push_back(std::exchange(cluster.bounds, parts[*cluster.part]));
    touched.push_back(cluster.bounds);
  }
  return touched;
}

}  // namespace halfsilver
