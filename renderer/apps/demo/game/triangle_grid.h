#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

// Where a sphere touches triangles. Both sides of a triangle count.
namespace halfsilver::demo {

using Corners = std::array<glm::dvec3, 3>;

struct Touch {
  glm::dvec3 point{0};  // of the triangle, nearest to the sphere's center
  double distance = 0;  // to the center
};

// Source: Ericson, Real-Time Collision Detection, 5.1.5.
glm::dvec3 nearestPoint(const Corners& triangle, const glm::dvec3& p);

// The nearest triangle closer than `reach` to the center, of these.
std::optional<Touch> nearestTouch(std::span<const Corners> triangles, const glm::dvec3& center, double reach);

// Static triangles in a uniform grid of cubic cells, each of which lists the triangles whose bounds reach into it.
class TriangleGrid {
 public:
  TriangleGrid() = default;
  TriangleGrid(std::vector<Corners> triangles, double cell);

  std::optional<Touch> nearest(const glm::dvec3& center, double reach) const;

  // How far a sphere gets from `from` along `way` before it touches: 0..1.
  double cast(const glm::dvec3& from, const glm::dvec3& way, double radius) const;

 private:
  std::size_t index(int x, int y, int z) const;
  glm::ivec3 cellOf(const glm::dvec3& p) const;

  std::vector<Corners> triangles_;
  glm::dvec3 low_{0};
  double cell_ = 1;
  glm::ivec3 size_{0};
  std::vector<std::uint32_t> begin_, list_;  // begin_[cell]..begin_[cell + 1] in list_
};

}  // namespace halfsilver::demo
