#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <halfsilver/bounds.h>
#include <halfsilver/model.h>
#include <halfsilver/scene.h>

namespace halfsilver {

// Where nearly all triangles of a scene lie. A few large ones, such as a ground that reaches to the horizon, would
// otherwise stretch a voxel grid until everything else lies in one voxel. It is the whole scene unless leaving out the
// largest triangles makes its longest side at least four times shorter.
struct SceneCore {
  Bounds bounds;                     // relative to Scene::origin
  std::vector<std::uint32_t> outer;  // triangles that reach beyond, ascending; at most kMaxOuterTriangles
};

inline constexpr std::size_t kMaxOuterTriangles = 32;

// Bounds and core of a scene whose vertices move. Triangles are measured in blocks, so that an update costs what moved.
class SceneExtents {
 public:
  static constexpr std::size_t kBlockTriangles = 256;

  SceneExtents() = default;
  explicit SceneExtents(const Scene& scene);

  // Follows moved vertices; the triangles are those that the object was made from. Returns how many blocks were
  // measured: those that may use a moved vertex.
  std::size_t update(const Scene& scene, std::span<const VertexRange> moved);

  // The blocks whose triangles may use a vertex of the ranges, which are merged; ascending.
  std::vector<std::uint32_t> blocksUsing(std::span<const VertexRange> merged) const;

  const Bounds& bounds() const { return bounds_; }  // of the vertices that triangles use, as Scene::bounds()
  const SceneCore& core() const { return core_; }

 private:
  struct Block {
    Bounds bounds;
    float largest = 0;                              // longest side of a triangle's bounds, of all triangles
    std::uint32_t firstVertex = 0, lastVertex = 0;  // all that the block uses lie between, inclusive
  };
  void measure(const Scene& scene, std::size_t block);
  void combine(const Scene& scene);
  float largestThatStays(const Scene& scene) const;

  std::vector<Block> blocks_;
  Bounds bounds_;
  SceneCore core_;
};

}  // namespace halfsilver
