#pragma once

#include <glm/glm.hpp>
#include <limits>

namespace halfsilver {

// Axis-aligned box; empty until a point is added.
struct Bounds {
  glm::vec3 low{std::numeric_limits<float>::max()};
  glm::vec3 high{std::numeric_limits<float>::lowest()};

  void add(const glm::vec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  void add(const Bounds& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  bool operator==(const Bounds&) const = default;
  bool empty() const { return low.x > high.x; }
  glm::vec3 extent() const { return empty() ? glm::vec3(0) : high - low; }
  glm::vec3 center() const { return empty() ? glm::vec3(0) : 0.5f * (low + high); }
  float diagonal() const { return glm::length(extent()); }
};

}  // namespace halfsilver
