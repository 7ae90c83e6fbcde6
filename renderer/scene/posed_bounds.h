#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include <halfsilver/bounds.h>
#include <halfsilver/pose.h>

namespace halfsilver {

// Where a pose takes an instance, from boxes of its rest vertices alone.
class InstanceShape {
 public:
  InstanceShape(const Rig& rig, const Instance& instance);

  struct Placed {
    Bounds bounds;  // holds all vertices; relative to the origin
    double largest =
        0;  // of the terms that a vertex is the sum of, absolute, if rest positions are relative to center()
    bool flat = false;   // a matrix squeezes space so far that its normals and its sign are a matter of rounding
    bool finite = true;  // within the range of floats
  };
  // `matrices` are the instance's placingMatrices(), `weights` its morph weights. A matrix moves the box of its
  // vertices as a whole, so the bounds are right for every pose but not the tightest.
  Placed at(std::span<const glm::dmat4> matrices, std::span<const double> weights, const glm::dvec3& origin) const;

  // Of the rest positions: a point of floats.
  const glm::vec3& center() const { return center_; }

 private:
  struct Box {
    glm::dvec3 low, high;
  };
  glm::vec3 center_{0};
  std::vector<Box> boxes_;   // of the vertices that each matrix moves, relative to center(); empty: low > high
  std::vector<Box> deltas_;  // of each morph target
};

}  // namespace halfsilver
