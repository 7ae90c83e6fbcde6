#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <halfsilver/bounds.h>

namespace halfsilver {

// A hierarchy of two children to a node, from which the wide one is made.
struct BinaryBvh {
  struct Node {
    Bounds box;
    std::uint32_t first = 0;  // of its triangles
    std::uint32_t count = 0;  // of them; children have a part each
    std::uint32_t left = 0;   // child; the other one is the next node. 0: a leaf
    bool leaf() const { return left == 0; }
  };
  std::vector<Node> nodes;  // the root first
  std::vector<std::uint32_t> triangles;
};

enum class Split {
  surfaceArea,  // where the surface-area heuristic says
  middle        // halves of equal count: deeper than it must be by nothing
};

// On up to `threads` threads. Nodes differ in their numbers from run to run, the tree does not.
BinaryBvh buildBinaryBvh(std::span<const Bounds> boxes, Split split, unsigned threads);

// Half the surface of a box.
inline float halfArea(const Bounds& box) {
  const glm::vec3 e = box.extent();
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

inline Bounds joined(const Bounds& a, const Bounds& b) { return {glm::min(a.low, b.low), glm::max(a.high, b.high)}; }

}  // namespace halfsilver
