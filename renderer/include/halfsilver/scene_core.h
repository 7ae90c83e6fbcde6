#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
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

// Triangles that poses move on the GPU, and a box that holds them in all of these poses.
struct PosedPart {
  VertexRange vertices;
  TriangleRange triangles;
  Bounds bounds;  // relative to Scene::origin
};

// The part that a triangle belongs to, if any, of parts in the order of their triangles.
std::optional<std::size_t> partOf(std::span<const PosedPart> posed, std::uint32_t triangle);

// Bounds and core of a scene whose vertices move. Triangles are measured in blocks, so that an update costs what moved.
class SceneExtents {
 public:
  static constexpr std::size_t kBlockTriangles = 256;

  SceneExtents() = default;
  // `posed`: in the order of their triangles. They count with their whole boxes, wherever they are at the time.
  explicit SceneExtents(const Scene& scene, std::vector<PosedPart> posed = {});

  // Follows moved vertices; the triangles are those that the object was made from. Returns how many blocks were
  // measured: those that may use a moved vertex.
  std::size_t update(const Scene& scene, std::span<const VertexRange> moved);

  // Where each posed part is now; an empty box: as before. Where one reaches beyond the part's own, bounds and core
  // grow, in steps that double, so that they change seldom. They follow from the present boxes alone, not from earlier
  // ones.
  void hold(std::span<const Bounds> boxes);

  // The blocks whose triangles may use a vertex of the ranges, which are merged; ascending.
  std::vector<std::uint32_t> blocksUsing(std::span<const VertexRange> merged) const;

  const Bounds& bounds() const { return bounds_; }  // holds all triangles; without posed parts Scene::bounds()
  const Bounds& usual() const { return usual_; }    // the same while no posed part leaves its own box
  const SceneCore& core() const { return core_; }
  std::span<const PosedPart> posed() const { return posed_; }
  std::span<const Bounds> held() const { return held_; }  // what each posed part is in, wherever it is now

 private:
  struct Block {
    Bounds bounds;                                  // of triangles that are not posed
    float largest = 0;                              // longest side of the bounds of one of these
    std::uint32_t firstVertex = 0, lastVertex = 0;  // all that the block uses lie between, inclusive
  };
  template <class Visit>
  void forEachStill(const Scene& scene, std::size_t block, const Visit& visit) const;
  void measure(const Scene& scene, std::size_t block);
  void combine(const Scene& scene);
  void findOuter(const Scene& scene, Bounds inner);
  void grow();
  float largestThatStays(const Scene& scene) const;

  std::vector<PosedPart> posed_;
  std::vector<Bounds> held_;  // of each posed part, at least its own
  std::vector<Block> blocks_;
  Bounds bounds_, usual_, usualCore_;
  SceneCore core_;
};

}  // namespace halfsilver
