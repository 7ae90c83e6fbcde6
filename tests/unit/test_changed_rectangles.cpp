// Where views of the shadow maps are out of date, and the clusters that say so.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <numeric>
#include <random>

#include <halfsilver/draw_clusters.h>
#include "passes/changed_rectangles.h"

namespace halfsilver {
namespace {

using glm::vec3;

const glm::ivec4 kTile{100, 50, 300, 200};

ShadowView fromAbove() {
  return {0, kTile,
          glm::ortho(-10.0f, 10.0f, -10.0f, 10.0f, 1.0f, 40.0f) * glm::lookAt(vec3(0, 20, 0), vec3(0), vec3(0, 0, -1))};
}

ShadowView fromALamp() {
  return {3, kTile,
          glm::frustum(-0.01f, 0.01f, -0.01f, 0.01f, 0.01f, 50.0f) *
              glm::lookAt(vec3(1, 2, 3), vec3(1, 2, 2), vec3(0, 1, 0))};
}

bool inside(const glm::ivec4& rectangle, const glm::vec2& texel) {
  return texel.x >= static_cast<float>(rectangle.x) && texel.x <= static_cast<float>(rectangle.x + rectangle.z) &&
         texel.y >= static_cast<float>(rectangle.y) && texel.y <= static_cast<float>(rectangle.y + rectangle.w);
}

// Boxes of all sizes at random, many of which reach behind the lamp.
TEST(ChangedRectangles, HoldEveryPointOfTheBoxesThatTheViewSees) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-9, 9), unit(0, 1);
  std::size_t seen = 0, whole = 0, runs = 0;
  for (const ShadowView& view : {fromAbove(), fromALamp()})
    for (int run = 0; run < 200; ++run) {
      std::vector<Bounds> boxes(1 + random() % 20);
      for (Bounds& box : boxes) {
        box.add({place(random), place(random), place(random)});
        box.add(box.low + 4 * unit(random) * vec3(unit(random), unit(random), unit(random)));
      }
      const std::vector<glm::ivec4> rectangles = changedRectangles(view, boxes);
      ASSERT_LE(rectangles.size(), kMaxChangedRectangles);
      for (const glm::ivec4& rectangle : rectangles) {
        EXPECT_TRUE(inside(kTile, {rectangle.x, rectangle.y}));
        EXPECT_TRUE(inside(kTile, {rectangle.x + rectangle.z, rectangle.y + rectangle.w}));
        whole += rectangle == kTile;
      }
      ++runs;
      for (const Bounds& box : boxes)
        for (int i = 0; i < 20; ++i) {
          const vec3 point = glm::mix(box.low, box.high, vec3(unit(random), unit(random), unit(random)));
          const glm::vec4 clip = view.worldToClip * glm::vec4(point, 1);
          const vec3 ndc = vec3(clip) / clip.w;
          if (clip.w <= 0 || glm::any(glm::greaterThan(glm::abs(ndc), vec3(1)))) continue;
          ++seen;
          const glm::vec2 texel = glm::vec2(kTile.x, kTile.y) + (0.5f * glm::vec2(ndc) + 0.5f) * glm::vec2(300, 200);
          EXPECT_TRUE(std::any_of(rectangles.begin(), rectangles.end(),
                                  [&](const glm::ivec4& rectangle) { return inside(rectangle, texel); }));
        }
    }
  EXPECT_GT(seen, 10000u);
  EXPECT_LT(whole, runs / 2);
}

TEST(ChangedRectangles, AreSmallAndApartForThingsThatAre) {
  const Bounds left{vec3(-8, 0, -8), vec3(-7, 1, -7)}, right{vec3(7, 0, 7), vec3(8, 1, 8)};
  const std::vector<glm::ivec4> rectangles = changedRectangles(fromAbove(), std::vector{left, right});
  ASSERT_EQ(rectangles.size(), 2u);
  for (const glm::ivec4& rectangle : rectangles) EXPECT_LE(rectangle.z * rectangle.w, 20 * 15);
}

TEST(ChangedRectangles, AreOneForWhatMovesOnByALittle) {
  const Bounds before{vec3(-1), vec3(1)}, after{vec3(-0.8f, -1, -1), vec3(1.2f, 1, 1)};
  EXPECT_EQ(changedRectangles(fromAbove(), std::vector{before, after}).size(), 1u);
}

TEST(ChangedRectangles, AreNoneForWhatTheViewDoesNotSee) {
  const Bounds aside{vec3(11, 0, 0), vec3(12, 1, 1)};
  EXPECT_TRUE(changedRectangles(fromAbove(), std::vector{aside, Bounds()}).empty());
}

// Triangles in a row along x, each with vertices of its own.
Scene row(std::uint32_t triangles) {
  Scene scene;
  scene.materials.resize(1);
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const auto x = static_cast<float>(t);
    for (const vec3& corner : {vec3(x, 0, 0), vec3(x + 1, 0, 0), vec3(x, 1, 0)})
      scene.vertices.push_back({.position = corner});
    scene.triangles.push_back({{3 * t, 3 * t + 1, 3 * t + 2}, 0});
  }
  return scene;
}

TEST(DrawClusters, GiveWhatMovesClustersOfItsOwn) {
  Scene scene = row(1000);
  std::vector<std::uint32_t> list(1000);
  std::iota(list.begin(), list.end(), 0u);
  const std::vector<DrawRange> ranges = {{0, 1000, false, false}};
  DrawClusters clusters(scene, list, ranges);
  EXPECT_TRUE(clusters.started().empty());
  // Two things that follow one another in the list, across the border of two clusters.
  const std::vector<VertexRange> moved = {{3 * 250, 3 * 4}, {3 * 254, 3 * 10}};
  for (int move = 0; move < 2; ++move) {
    for (const VertexRange& range : moved)
      for (std::uint32_t v = range.first; v < range.first + range.count; ++v) scene.vertices[v].position.y += 1;
    const std::vector<Bounds> boxes = clusters.update(scene, moved);
    for (const Bounds& box : boxes) {
      if (move > 0) {
        EXPECT_LE(box.extent().x, 10) << "what stands beside it is not in its bounds";
      }
    }
    EXPECT_EQ(clusters.started().size(), 2u);
  }
  std::uint32_t next = 0, moving = 0;
  for (const DrawCluster& cluster : clusters.all()) {
    EXPECT_EQ(cluster.first, next);
    next += cluster.count;
    if (cluster.moves) moving += cluster.count;
    EXPECT_EQ(cluster.moves, cluster.bounds.low.y == 2);
  }
  EXPECT_EQ(next, 1000u);
  EXPECT_EQ(moving, 14u);
}

}  // namespace
}  // namespace halfsilver
