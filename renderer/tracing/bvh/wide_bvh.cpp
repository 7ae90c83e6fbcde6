#include "tracing/bvh/wide_bvh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "tracing/bvh/binary_bvh.h"

namespace halfsilver {
namespace {

using shared::BvhNode;

constexpr int kMaxByte = 255;

float stepOf(const BvhNode& node, int axis) {
  return std::bit_cast<float>((node.exponents >> (8 * axis) & 255u) << 23);
}

std::uint32_t byteOf(std::uint32_t word, int child) { return word >> (8 * child) & 255u; }

bool isLeaf(std::uint32_t word) { return (word & BVH_LEAF) != 0; }
std::uint32_t leafFirst(std::uint32_t word) { return word & BVH_LEAF_FIRST; }
std::uint32_t leafCount(std::uint32_t word) { return ((word & ~BVH_LEAF) >> BVH_LEAF_SHIFT) + 1; }

// A power of two, as the exponent of a float, of which 255 reach from low to high.
std::uint32_t exponentFor(float extent) {
  const auto exponent = static_cast<int>(std::bit_cast<std::uint32_t>(extent / kMaxByte) >> 23);
  return static_cast<std::uint32_t>(std::clamp(exponent + 1, 1, 254));
}

// The smallest byte whose bound is not below `value`, or the largest that is not above it: bounds are what the shader's
// sum gives, and always around the box.
std::uint32_t quantized(float value, float origin, float step, bool up) {
  int byte = std::clamp(static_cast<int>((value - origin) / step), 0, kMaxByte);
  const auto bound = [&] { return origin + static_cast<float>(byte) * step; };
  if (up) {
    while (byte < kMaxByte && bound() < value) ++byte;
  } else {
    while (byte > 0 && bound() > value) --byte;
  }
  return static_cast<std::uint32_t>(byte);
}

// The node's boxes from those of its children; a child without a box is none.
void setBoxes(std::span<const Bounds> children, BvhNode& node) {
  Bounds all;
  for (const Bounds& child : children) all = joined(all, child);
  node.origin = all.low;
  node.exponents = 0;
  for (int axis = 0; axis < 3; ++axis) {
    std::uint32_t exponent = exponentFor(all.extent()[axis]);
    // The sum with the origin rounds: one step more may be needed.
    while (all.low[axis] + kMaxByte * std::bit_cast<float>(exponent << 23) < all.high[axis]) ++exponent;
    node.exponents |= exponent << (8 * axis);
    node.low[axis] = node.high[axis] = 0;
    const float step = stepOf(node, axis);
    for (int child = 0; child < static_cast<int>(children.size()); ++child) {
      const Bounds& box = children[static_cast<std::size_t>(child)];
      if (box.empty()) continue;
      node.low[axis] |= quantized(box.low[axis], node.origin[axis], step, false) << (8 * child);
      node.high[axis] |= quantized(box.high[axis], node.origin[axis], step, true) << (8 * child);
    }
  }
}

class Widening {
 public:
  explicit Widening(const BinaryBvh& source, bool byCount) : source_(source), byCount_(byCount) {}

  WideBvh run() {
    if (!source_.triangles.empty()) add(0, 0, 1);
    if (wide_.nodes.empty()) wide_.nodes.push_back(emptyNode(0));
    wide_.triangles = source_.triangles;
    return std::move(wide_);
  }

 private:
  static BvhNode emptyNode(std::uint32_t parent) {
    BvhNode node{};
    node.parent = parent;
    std::fill(std::begin(node.children), std::end(node.children), BVH_NO_CHILD);
    return node;
  }

  // Up to four descendants of the binary node: the largest one that has children gives way to them.
  std::vector<std::uint32_t> childrenOf(std::uint32_t number) const {
    if (source_.nodes[number].leaf()) return {number};  // a root
    std::vector<std::uint32_t> children = {source_.nodes[number].left, source_.nodes[number].left + 1};
    while (children.size() < BVH_WIDTH) {
      auto largest = children.end();
      float largestSize = -1;
      for (auto child = children.begin(); child != children.end(); ++child) {
        const BinaryBvh::Node& node = source_.nodes[*child];
        const float size = byCount_ ? static_cast<float>(node.count) : halfArea(node.box);
        if (node.leaf() || size <= largestSize) continue;
        largest = child;
        largestSize = size;
      }
      if (largest == children.end()) break;
      const std::uint32_t left = source_.nodes[*largest].left;
      *largest = left;
      children.push_back(left + 1);
    }
    return children;
  }

  std::uint32_t add(std::uint32_t number, std::uint32_t parent, int level) {
    const auto place = static_cast<std::uint32_t>(wide_.nodes.size());
    wide_.nodes.push_back(emptyNode(parent));
    wide_.depth = std::max(wide_.depth, level);
    // What is deeper is not used.
    if (level > BVH_MAX_DEPTH) return place;
    const std::vector<std::uint32_t> children = childrenOf(number);
    for (std::size_t i = 0; i < children.size(); ++i) {
      const BinaryBvh::Node& child = source_.nodes[children[i]];
      // Not into the vector's element at once: it moves.
      const std::uint32_t word = child.leaf() ? BVH_LEAF | (child.count - 1) << BVH_LEAF_SHIFT | child.first
                                              : add(children[i], place, level + 1);
      wide_.nodes[place].children[i] = word;
    }
    return place;
  }

  const BinaryBvh& source_;
  bool byCount_;
  WideBvh wide_;
};

}  // namespace

WideBvh buildBvh(std::span<const Bounds> boxes, unsigned threads) {
  WideBvh bvh = Widening(buildBinaryBvh(boxes, Split::surfaceArea, threads), false).run();
  // Triangles that get smaller without end make a tree that is deeper than a ray's stack. Halves of equal count, opened
  // by count, are a quarter of the triangles at each level.
  if (bvh.depth > BVH_MAX_DEPTH) bvh = Widening(buildBinaryBvh(boxes, Split::middle, threads), true).run();
  refitBvh(boxes, bvh);
  return bvh;
}

void refitBvh(std::span<const Bounds> boxes, WideBvh& bvh) {
  std::vector<Bounds> nodeBoxes(bvh.nodes.size());
  double cost = 0;
  for (std::size_t number = bvh.nodes.size(); number-- > 0;) {
    BvhNode& node = bvh.nodes[number];
    std::array<Bounds, BVH_WIDTH> children;
    for (std::size_t i = 0; i < BVH_WIDTH; ++i) {
      const std::uint32_t word = node.children[i];
      if (word == BVH_NO_CHILD) continue;
      if (isLeaf(word)) {
        for (std::uint32_t k = 0; k < leafCount(word); ++k)
          children[i] = joined(children[i], boxes[bvh.triangles[leafFirst(word) + k]]);
        cost += static_cast<double>(halfArea(children[i])) * leafCount(word);
      } else {
        children[i] = nodeBoxes[word];
      }
      nodeBoxes[number] = joined(nodeBoxes[number], children[i]);
    }
    cost += static_cast<double>(halfArea(nodeBoxes[number]));
    if (!nodeBoxes[number].empty()) setBoxes(children, node);
  }
  const auto area = static_cast<double>(halfArea(nodeBoxes[0]));
  bvh.cost = area > 0 ? cost / area : 0;
}

Bounds childBox(const BvhNode& node, int child) {
  Bounds box;
  for (int axis = 0; axis < 3; ++axis) {
    const float step = stepOf(node, axis);
    box.low[axis] = node.origin[axis] + static_cast<float>(byteOf(node.low[axis], child)) * step;
    box.high[axis] = node.origin[axis] + static_cast<float>(byteOf(node.high[axis], child)) * step;
  }
  return box;
}

}  // namespace halfsilver
