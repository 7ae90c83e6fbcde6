#include "apps/demo/game/triangle_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace halfsilver::demo {

using glm::dvec3;

dvec3 nearestPoint(const Corners& triangle, const dvec3& p) {
  const auto& [a, b, c] = triangle;
  const dvec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const dvec3 bp = p - b;
  const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
  const dvec3 cp = p - c;
  const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double scale = 1 / (va + vb + vc);
  return a + ab * (vb * scale) + ac * (vc * scale);
}

std::optional<Touch> nearestTouch(std::span<const Corners> triangles, const dvec3& center, double reach) {
  std::optional<Touch> found;
  for (const Corners& triangle : triangles) {
    const dvec3 point = nearestPoint(triangle, center);
    const double distance = glm::distance(point, center);
    if (distance < (found ? found->distance : reach)) found = {point, distance};
  }
  return found;
}

TriangleGrid::TriangleGrid(std::vector<Corners> triangles, double cell)
    : triangles_(std::move(triangles)), cell_(cell) {
  if (triangles_.empty()) return;
  dvec3 high = low_ = triangles_.front()[0];
  for (const Corners& triangle : triangles_)
    for (const dvec3& corner : triangle) {
      low_ = glm::min(low_, corner);
      high = glm::max(high, corner);
    }
  size_ = glm::ivec3(glm::floor((high - low_) / cell_)) + 1;
  const auto cells =
      static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(size_.z);
  const auto forCells = [&](const Corners& triangle, auto&& visit) {
    const glm::ivec3 from = cellOf(glm::min(triangle[0], glm::min(triangle[1], triangle[2])));
    const glm::ivec3 to = cellOf(glm::max(triangle[0], glm::max(triangle[1], triangle[2])));
    for (int z = from.z; z <= to.z; ++z)
      for (int y = from.y; y <= to.y; ++y)
        for (int x = from.x; x <= to.x; ++x) visit(index(x, y, z));
  };
  begin_.assign(cells + 1, 0);
  for (const Corners& triangle : triangles_) forCells(triangle, [&](std::size_t at) { ++begin_[at + 1]; });
  for (std::size_t i = 0; i < cells; ++i) begin_[i + 1] += begin_[i];
  list_.resize(begin_.back());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t t = 0; t < triangles_.size(); ++t)
    forCells(triangles_[t], [&](std::size_t at) { list_[next[at]++] = t; });
}

std::size_t TriangleGrid::index(int x, int y, int z) const {
  const auto at = [](int value) { return static_cast<std::size_t>(value); };
  return (at(z) * at(size_.y) + at(y)) * at(size_.x) + at(x);
}

glm::ivec3 TriangleGrid::cellOf(const dvec3& p) const {
  const dvec3 cell = glm::clamp(glm::floor((p - low_) / cell_), dvec3(0), dvec3(size_ - 1));
  return glm::ivec3(cell);
}

std::optional<Touch> TriangleGrid::nearest(const dvec3& center, double reach) const {
  std::optional<Touch> found;
  if (triangles_.empty()) return found;
  const glm::ivec3 from = cellOf(center - reach), to = cellOf(center + reach);
  for (int z = from.z; z <= to.z; ++z)
    for (int y = from.y; y <= to.y; ++y)
      for (int x = from.x; x <= to.x; ++x) {
        const std::size_t at = index(x, y, z);
        for (std::uint32_t i = begin_[at]; i < begin_[at + 1]; ++i) {
          const dvec3 point = nearestPoint(triangles_[list_[i]], center);
          const double distance = glm::distance(point, center);
          if (distance < (found ? found->distance : reach)) found = {point, distance};
        }
      }
  return found;
}

double TriangleGrid::cast(const dvec3& from, const dvec3& way, double radius) const {
  const double length = glm::length(way);
  if (!(length > 0)) return 1;
  // The distance to the nearest triangle is how far the sphere may go at least.
  constexpr double kClose = 1e-3;
  double gone = 0;
  while (gone < length) {
    const double reach = radius + std::min(length - gone, 0.5) + kClose;
    const std::optional<Touch> touch = nearest(from + way * (gone / length), reach);
    const double room = (touch ? touch->distance : reach) - radius;
    if (room < kClose) break;
    gone += room;
  }
  return std::min(gone / length, 1.0);
}

}  // namespace halfsilver::demo
