#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include <halfsilver/bounds.h>

namespace halfsilver {

// The layout of shaders/shared/passes/bvh.h.
namespace shared {
using glm::vec3;
using uint = std::uint32_t;
#include "shared/passes/bvh.h"
static_assert(offsetof(BvhNode, exponents) == 12 && offsetof(BvhNode, low) == 16 && offsetof(BvhNode, parent) == 28 &&
              offsetof(BvhNode, high) == 32 && offsetof(BvhNode, children) == 48 && sizeof(BvhNode) == 64);
}  // namespace shared

// A hierarchy of boxes around triangles, four children to a node, as the GPU walks through it. Children come after
// their parents; node 0 is the root.
struct WideBvh {
  std::vector<shared::BvhNode> nodes;
  std::vector<std::uint32_t> triangles;  // numbers, leaf by leaf
  int depth = 0;                         // levels of nodes, at most BVH_MAX_DEPTH
  double cost = 0;                       // expected visits and tests of a ray that passes the root's box
};

// `boxes`: of the triangles. Splits where the surface-area heuristic says, among 16 bins per axis (Wald 2007), on up to
// `threads` threads; the result does not depend on their number.
WideBvh buildBvh(std::span<const Bounds> boxes, unsigned threads);

// Fits the nodes to triangles that moved; which of them share a node stays.
void refitBvh(std::span<const Bounds> boxes, WideBvh& bvh);

// The box of a node's child, which the root's own are not: as shaders compute it.
Bounds childBox(const shared::BvhNode& node, int child);

}  // namespace halfsilver
