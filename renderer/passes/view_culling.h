#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include <halfsilver/bounds.h>
#include <halfsilver/draw_clusters.h>

namespace halfsilver {

// Of clip coordinates, relative to the sum of their terms: a device rounds, too, and may draw what is beside a view by
// less than that.
inline constexpr float kClipRounding = 1e-5f;

// The space that a view of clip coordinates -w..w sees.
class Frustum {
 public:
  explicit Frustum(const glm::mat4& worldToClip);

  // Whether it may see something of a box; true if in doubt.
  bool mayTouch(const Bounds& bounds) const;

 private:
  std::array<glm::vec4, 6> planes_;  // inside where dot(plane, (p, 1)) >= 0
};

// Vertices to draw: parallel lists as glMultiDrawArrays takes them.
struct VertexRuns {
  std::vector<std::int32_t> firsts, counts;
  std::size_t triangles = 0;

  void add(const DrawCluster& cluster);  // joined with the last one if it follows that
};

struct VisibleRuns {
  VertexRuns opaque, cut;
};

enum class Casters { all, still, moving };  // see DrawCluster::moves

// The clusters that one of the frusta may see.
VisibleRuns visibleRuns(std::span<const DrawCluster> clusters, Casters casters, std::span<const Frustum> frusta);

}  // namespace halfsilver
