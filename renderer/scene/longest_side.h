#pragma once

#include <algorithm>

#include <halfsilver/bounds.h>

namespace halfsilver {

// 0 for an empty box, and never NaN.
inline float longestSide(const Bounds& bounds) {
  const glm::vec3 extent = bounds.extent();
  float longest = 0;
  for (int axis = 0; axis < 3; ++axis) longest = std::max(longest, extent[axis]);
  return longest;
}

}  // namespace halfsilver
