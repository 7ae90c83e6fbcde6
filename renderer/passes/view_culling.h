#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include <halfsilver/bounds.h>
#include <halfsilver/draw_clusters.h>

namespace halfsilver {

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
};

// The clusters that a view may see, those that follow one another joined.
VertexRuns visibleRuns(std::span<const DrawCluster> clusters, const Frustum& frustum, bool cut);

}  // namespace halfsilver
