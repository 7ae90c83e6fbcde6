#include "apps/demo/cell_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace halfsilver::demo {
namespace {

constexpr std::size_t kMaxCells = 3000;
constexpr float kNearest = 1e-3f;  // of the distance to the target: behind it there is nothing to see

class Projection {
 public:
  Projection(const Camera& camera, float aspect) : eye_(camera.eye) {
    const glm::vec3 towards = camera.target - camera.eye;
    near_ = kNearest * glm::length(towards);
    forward_ = glm::normalize(towards);
    const float tangent = std::tan(0.5f * camera.verticalFov);
    right_ = glm::normalize(glm::cross(forward_, camera.up));
    up_ = glm::cross(right_, forward_) / tangent;
    right_ /= tangent * aspect;
  }

  float along(const glm::vec3& point) const { return glm::dot(point - eye_, forward_); }
  std::optional<glm::vec2> operator()(const glm::vec3& point) const {
    const float distance = along(point);
    if (distance < near_) return std::nullopt;
    const glm::vec2 screen(glm::dot(point - eye_, right_), glm::dot(point - eye_, up_));
    return glm::vec2(0.5f, 0.5f) + glm::vec2(0.5f, -0.5f) * screen / distance;
  }

 private:
  glm::vec3 eye_, forward_, right_, up_;
  float near_ = 0;
};

// From green for one entry to red for many, on a logarithmic scale.
std::uint32_t colorOf(std::uint32_t entries) {
  const float length = std::clamp(std::log2(1 + static_cast<float>(entries)) / 8, 0.0f, 1.0f);
  const auto red = static_cast<std::uint32_t>(255 * length), green = static_cast<std::uint32_t>(255 * (1 - length));
  return 0xa0000000u | 0x40u << 16 | green << 8 | red;
}

}  // namespace

std::vector<Segment> cellLines(const StructureCells& structure, Cells cells, const Camera& camera, float aspect) {
  std::vector<StructureCell> shown = cells == Cells::bricks ? structure.bricks : structure.voxels;
  const Projection project(camera, aspect);
  const auto distance = [&](const StructureCell& cell) { return glm::distance(cell.bounds.center(), camera.eye); };
  std::erase_if(shown, [&](const StructureCell& cell) {
    const auto center = project(cell.bounds.center());
    return !center || glm::any(glm::lessThan(*center, glm::vec2(-0.1f))) ||
           glm::any(glm::greaterThan(*center, glm::vec2(1.1f)));
  });
  if (shown.size() > kMaxCells) {
    std::nth_element(shown.begin(), shown.begin() + kMaxCells, shown.end(),
                     [&](const StructureCell& a, const StructureCell& b) { return distance(a) < distance(b); });
    shown.resize(kMaxCells);
  }
  std::vector<Segment> segments;
  for (const StructureCell& cell : shown) {
    const auto corner = [&](int number) {
      const glm::vec3 high(number & 1, number >> 1 & 1, number >> 2 & 1);
      return project(glm::mix(cell.bounds.low, cell.bounds.high, high));
    };
    for (int from = 0; from < 8; ++from)
      for (const int axis : {1, 2, 4}) {
        if ((from & axis) != 0) continue;
        const auto a = corner(from), b = corner(from | axis);
        if (a && b) segments.push_back({*a, *b, colorOf(cell.entries)});
      }
  }
  return segments;
}

}  // namespace halfsilver::demo
