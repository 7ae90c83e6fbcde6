#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <halfsilver/bounds.h>
#include <halfsilver/model.h>
#include <halfsilver/scene.h>
#include <halfsilver/scene_core.h>

namespace halfsilver {

// A run of the draw list that is drawn with one state.
struct DrawRange {
  std::uint32_t first = 0, count = 0;  // triangles
  bool doubleSided = false;
  bool cut = false;  // needs the alpha test

  bool operator==(const DrawRange&) const = default;
};

// A piece of a range, small enough to be left out by views that do not see it.
struct DrawCluster {
  std::uint32_t first = 0, count = 0;  // triangles of the draw list
  bool cut = false;
  bool moves = false;               // has moved since the scene was uploaded
  std::optional<std::size_t> part;  // the posed part that all of it belongs to
  Bounds bounds;
  std::uint32_t firstVertex = 0, lastVertex = 0;  // all that it uses lie between, inclusive
};

// The draw list in clusters of neighbors: triangles keep the scene's order within a range. Neighbors that lie far apart
// or are of quite another size are in different clusters, if that does not make them many: bounds are those of a thing.
// A cluster of which a part moves is split, so that what moves has clusters of its own, with bounds of its own.
class DrawClusters {
 public:
  static constexpr std::uint32_t kTriangles = 256;

  DrawClusters() = default;
  // Posed parts are in clusters of their own, with the bounds of the whole part.
  DrawClusters(const Scene& scene, std::vector<std::uint32_t> drawList, std::span<const DrawRange> ranges,
               std::span<const PosedPart> posed = {});

  // Follows moved vertices; the triangles are those that the object was made from. Returns where clusters that may use
  // one of them were, and where they are.
  std::vector<Bounds> update(const Scene& scene, std::span<const VertexRange> moved);

  // The same for posed parts, which have come into these boxes (by their number; empty: has not moved).
  std::vector<Bounds> follow(std::span<const Bounds> parts);

  std::span<const DrawCluster> all() const { return clusters_; }
  // Where clusters were before they moved for the first time, one after the other.
  std::span<const Bounds> started() const { return started_; }
  std::span<const std::uint32_t> drawList() const { return drawList_; }  // numbers of triangles

 private:
  // byThing: as said above.
  void group(const Scene& scene, std::span<const DrawRange> ranges, std::span<const PosedPart> posed, bool byThing);

  std::vector<std::uint32_t> drawList_;
  std::vector<DrawCluster> clusters_;
  std::vector<Bounds> started_;
};

}  // namespace halfsilver
