// The hierarchy of the bvh method, without GL.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "tracing/bvh/wide_bvh.h"

namespace halfsilver {
namespace {

std::vector<Bounds> randomBoxes(std::size_t count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-10, 10), size(0, 0.5f);
  std::vector<Bounds> boxes(count);
  for (Bounds& box : boxes) {
    const glm::vec3 at(place(random), 0.2f * place(random), place(random));
    box.add(at);
    box.add(at + glm::vec3(size(random), size(random), size(random)));
  }
  return boxes;
}

bool contains(const Bounds& outer, const Bounds& inner) {
  return glm::all(glm::lessThanEqual(outer.low, inner.low)) && glm::all(glm::greaterThanEqual(outer.high, inner.high));
}

// Each triangle is in one leaf, its box within those of all nodes above; parents know their children.
void expectSound(const WideBvh& bvh, const std::vector<Bounds>& boxes) {
  std::vector<int> seen(boxes.size(), 0);
  struct Open {
    std::uint32_t node;
    std::vector<Bounds> above;
  };
  std::vector<Open> open = {{0, {}}};
  std::size_t nodes = 0, depth = 0;
  while (!open.empty()) {
    const Open next = std::move(open.back());
    open.pop_back();
    ++nodes;
    depth = std::max(depth, next.above.size() + 1);
    const shared::BvhNode& node = bvh.nodes[next.node];
    for (int i = 0; i < BVH_WIDTH; ++i) {
      const std::uint32_t word = node.children[i];
      if (word == BVH_NO_CHILD) continue;
      std::vector<Bounds> above = next.above;
      above.push_back(childBox(node, i));
      if ((word & BVH_LEAF) == 0) {
        ASSERT_GT(word, next.node);
        ASSERT_EQ(bvh.nodes[word].parent, next.node);
        open.push_back({word, above});
        continue;
      }
      const std::uint32_t first = word & BVH_LEAF_FIRST, count = ((word & ~BVH_LEAF) >> BVH_LEAF_SHIFT) + 1;
      for (std::uint32_t k = first; k < first + count; ++k) {
        ASSERT_LT(k, bvh.triangles.size());
        const std::uint32_t triangle = bvh.triangles[k];
        ++seen[triangle];
        for (const Bounds& box : above) EXPECT_TRUE(contains(box, boxes[triangle])) << triangle;
      }
    }
  }
  for (const int count : seen) EXPECT_EQ(count, 1);
  EXPECT_EQ(nodes, bvh.nodes.size());
  EXPECT_EQ(depth, static_cast<std::size_t>(bvh.depth));
  EXPECT_LE(bvh.depth, BVH_MAX_DEPTH);
}

TEST(WideBvh, BoxesOfNodesContainTheirTriangles) {
  for (const std::size_t count : {1u, 2u, 4u, 5u, 17u, 1000u}) {
    SCOPED_TRACE(count);
    const std::vector<Bounds> boxes = randomBoxes(count);
    expectSound(buildBvh(boxes, 2), boxes);
  }
}

TEST(WideBvh, OfNothingIsARootWithoutChildren) {
  const WideBvh bvh = buildBvh({}, 2);
  ASSERT_EQ(bvh.nodes.size(), 1u);
  for (const std::uint32_t word : bvh.nodes[0].children) EXPECT_EQ(word, BVH_NO_CHILD);
}

TEST(WideBvh, DoesNotDependOnTheNumberOfThreads) {
  const std::vector<Bounds> boxes = randomBoxes(30000);
  const WideBvh one = buildBvh(boxes, 1), two = buildBvh(boxes, 2), four = buildBvh(boxes, 4);
  for (const WideBvh* other : {&two, &four}) {
    ASSERT_EQ(one.nodes.size(), other->nodes.size());
    EXPECT_EQ(std::memcmp(one.nodes.data(), other->nodes.data(), one.nodes.size() * sizeof(shared::BvhNode)), 0);
    EXPECT_EQ(one.triangles, other->triangles);
  }
}

TEST(WideBvh, SplitsWhereItPays) {
  const std::vector<Bounds> boxes = randomBoxes(20000);
  const WideBvh bvh = buildBvh(boxes, 2);
  // Two triangles to a leaf and three children to a node, about; a ray sees a small part of them.
  EXPECT_LT(bvh.nodes.size(), boxes.size() / 2);
  EXPECT_LT(bvh.cost, 150);
  EXPECT_GT(bvh.cost, 5);
}

// Each triangle is half as large as the one before and lies beside it: the heuristic peels off one at a time.
TEST(WideBvh, StaysWithinAStackWhateverTheScene) {
  std::vector<Bounds> boxes;
  for (int i = 0; i < 120; ++i) {
    const float size = std::exp2(static_cast<float>(-i));
    Bounds box;
    box.add({size, 0, 0});
    box.add({1.5f * size, size, size});
    boxes.push_back(box);
  }
  expectSound(buildBvh(boxes, 2), boxes);
}

TEST(WideBvh, FitsTrianglesThatMoved) {
  std::vector<Bounds> boxes = randomBoxes(5000);
  WideBvh bvh = buildBvh(boxes, 2);
  const double before = bvh.cost;
  refitBvh(boxes, bvh);
  EXPECT_EQ(bvh.cost, before);
  std::mt19937 random(9);
  std::uniform_real_distribution<float> way(-3, 3);
  for (std::size_t i = 0; i < boxes.size(); i += 7) {
    const glm::vec3 by(way(random), way(random), way(random));
    boxes[i].low += by;
    boxes[i].high += by;
  }
  refitBvh(boxes, bvh);
  expectSound(bvh, boxes);
  EXPECT_GT(bvh.cost, 1.3 * before);
}

}  // namespace
}  // namespace halfsilver
