#include <halfsilver/draw_clusters.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "scene/vertex_ranges.h"

namespace halfsilver {
namespace {

void measure(const Scene& scene, std::span<const std::uint32_t> triangles, DrawCluster& cluster) {
  cluster.bounds = Bounds();
  cluster.firstVertex = std::numeric_limits<std::uint32_t>::max();
  cluster.lastVertex = 0;
  for (const std::uint32_t triangle : triangles)
    for (const std::uint32_t vertex : scene.triangles[triangle].vertices) {
      cluster.bounds.add(scene.vertices[vertex].position);
      cluster.firstVertex = std::min(cluster.firstVertex, vertex);
      cluster.lastVertex = std::max(cluster.lastVertex, vertex);
    }
}

}  // namespace

DrawClusters::DrawClusters(const Scene& scene, std::vector<std::uint32_t> drawList, std::span<const DrawRange> ranges)
    : drawList_(std::move(drawList)) {
  for (const DrawRange& range : ranges)
    for (std::uint32_t done = 0; done < range.count; done += kTriangles) {
      DrawCluster& cluster = clusters_.emplace_back();
      cluster.first = range.first + done;
      cluster.count = std::min(kTriangles, range.count - done);
      cluster.cut = range.cut;
      measure(scene, std::span(drawList_).subspan(cluster.first, cluster.count), cluster);
    }
}

std::vector<Bounds> DrawClusters::update(const Scene& scene, std::span<const VertexRange> moved) {
  const std::vector<VertexRange> ranges = mergeRanges(moved);
  std::vector<Bounds> touched;
  for (DrawCluster& cluster : clusters_) {
    if (!touchesRange(ranges, cluster.firstVertex, cluster.lastVertex)) continue;
    touched.push_back(cluster.bounds);
    measure(scene, std::span(drawList_).subspan(cluster.first, cluster.count), cluster);
    touched.push_back(cluster.bounds);
  }
  return touched;
}

}  // namespace halfsilver
