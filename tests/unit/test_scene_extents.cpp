#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <random>

#include <halfsilver/scene_core.h>

namespace halfsilver {
namespace {

using glm::vec3;

// The core from its definition, with all triangles sorted.
SceneCore definedCore(const Scene& scene) {
  const auto boundsOf = [&](const Triangle& triangle) {
    Bounds bounds;
    for (const std::uint32_t vertex : triangle.vertices) bounds.add(scene.vertices[vertex].position);
    return bounds;
  };
  const auto longest = [](const vec3& size) { return std::max({size.x, size.y, size.z}); };
  const SceneCore whole{scene.bounds(), {}};
  if (scene.triangles.size() <= kMaxOuterTriangles) return whole;
  std::vector<float> sizes;
  for (const Triangle& triangle : scene.triangles) sizes.push_back(longest(boundsOf(triangle).extent()));
  std::vector<float> sorted = sizes;
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  SceneCore core;
  for (std::size_t i = 0; i < sizes.size(); ++i)
    if (sizes[i] <= sorted[kMaxOuterTriangles]) {
      core.bounds.add(boundsOf(scene.triangles[i]).low);
      core.bounds.add(boundsOf(scene.triangles[i]).high);
    }
  if (4 * longest(core.bounds.extent()) > longest(whole.bounds.extent())) return whole;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const Bounds bounds = boundsOf(scene.triangles[i]);
    const bool beyond = glm::any(glm::lessThan(bounds.low, core.bounds.low)) ||
                        glm::any(glm::greaterThan(bounds.high, core.bounds.high));
    if (sizes[i] > sorted[kMaxOuterTriangles] && beyond) core.outer.push_back(static_cast<std::uint32_t>(i));
  }
  return core;
}

bool sameBits(const vec3& a, const vec3& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (std::bit_cast<std::uint32_t>(a[axis]) != std::bit_cast<std::uint32_t>(b[axis])) return false;
  return true;
}
bool sameBits(const Bounds& a, const Bounds& b) { return sameBits(a.low, b.low) && sameBits(a.high, b.high); }

void expectExtentsOf(const SceneExtents& extents, const Scene& scene) {
  EXPECT_TRUE(sameBits(extents.bounds(), scene.bounds()));
  const SceneCore fresh = SceneExtents(scene).core(), defined = definedCore(scene);
  EXPECT_TRUE(sameBits(extents.core().bounds, fresh.bounds));
  EXPECT_EQ(extents.core().outer, fresh.outer);
  EXPECT_EQ(fresh.bounds.low, defined.bounds.low);
  EXPECT_EQ(fresh.bounds.high, defined.bounds.high);
  EXPECT_EQ(fresh.outer, defined.outer);
}

class RandomScenes {
 public:
  explicit RandomScenes(unsigned seed) : random_(seed) {}

  // A few hundred to a few thousand triangles near the origin, which share vertices; some vertices are unused, some
  // triangles degenerate and up to 40 much larger than the rest.
  Scene scene() {
    Scene scene;
    const std::size_t vertices = 3 + below(4000), triangles = below(3000);
    for (std::size_t v = 0; v < vertices; ++v) scene.vertices.push_back({.position = point(1)});
    for (std::size_t t = 0; t < triangles; ++t) {
      const std::size_t near = below(vertices);
      const auto corner = [&] { return static_cast<std::uint32_t>(std::min(near + below(6), vertices - 1)); };
      const std::uint32_t a = corner();
      scene.triangles.push_back({{a, below(10) == 0 ? a : corner(), corner()}, 0});
    }
    for (std::size_t large = below(41); large > 0 && !scene.triangles.empty(); --large)
      for (const std::uint32_t vertex : scene.triangles[below(scene.triangles.size())].vertices)
        scene.vertices[vertex].position = point(5000);
    return scene;
  }

  // Moves vertices in a few ranges, which may overlap or be empty: a little, far away, or back to the middle.
  std::vector<VertexRange> move(Scene& scene) {
    std::vector<VertexRange> ranges;
    for (std::size_t count = 1 + below(4); count > 0; --count) {
      const std::size_t first = below(scene.vertices.size() + 1);
      const std::size_t size = std::min(scene.vertices.size() - first, below(2) ? below(5) : below(400));
      const float radius = std::pow(10.0f, static_cast<float>(below(5)) - 1);
      for (std::size_t v = first; v < first + size; ++v)
        scene.vertices[v].position = below(20) == 0 ? vec3(-0.0f) : point(radius);
      ranges.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(size)});
    }
    return ranges;
  }

 private:
  std::size_t below(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }
  vec3 point(float radius) {
    std::uniform_real_distribution<float> coordinate(-radius, radius);
    const float x = coordinate(random_), y = coordinate(random_), z = coordinate(random_);
    return {x, y, z};
  }

  std::mt19937 random_;
};

TEST(SceneExtents, FollowRandomMovesOfRandomScenes) {
  std::size_t withOuter = 0, withoutOuter = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    RandomScenes random(seed);
    Scene scene = random.scene();
    SceneExtents extents(scene);
    expectExtentsOf(extents, scene);
    for (int i = 0; i < 15; ++i) {
      extents.update(scene, random.move(scene));
      expectExtentsOf(extents, scene);
      ++(extents.core().outer.empty() ? withoutOuter : withOuter);
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(withOuter, 30u);
  EXPECT_GT(withoutOuter, 200u);
}

// Blocks of triangles with vertices of their own, in rows.
Scene rows(std::size_t triangles) {
  Scene scene;
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    const vec3 at(0.1f * static_cast<float>(t % 100), 0, 0.1f * static_cast<float>(t / 100));
    for (const vec3& corner : {vec3(0), vec3(0.05f, 0, 0), vec3(0, 0, 0.05f)})
      scene.vertices.push_back({.position = at + corner});
    scene.triangles.push_back({{first, first + 1, first + 2}, 0});
  }
  return scene;
}

TEST(SceneExtents, OnlyBlocksThatMayUseAMovedVertexAreMeasured) {
  constexpr std::size_t kBlocks = 100;
  constexpr auto kVertices = static_cast<std::uint32_t>(3 * SceneExtents::kBlockTriangles);
  Scene scene = rows(kBlocks * SceneExtents::kBlockTriangles);
  SceneExtents extents(scene);
  const auto moved = [&](std::vector<VertexRange> ranges) { return extents.update(scene, ranges); };
  EXPECT_EQ(moved({}), 0u);
  EXPECT_EQ(moved({{7, 0}}), 0u);
  EXPECT_EQ(moved({{0, 1}}), 1u);
  EXPECT_EQ(moved({{kVertices - 1, 1}}), 1u) << "the last vertex of the first block";
  EXPECT_EQ(moved({{kVertices - 1, 2}}), 2u);
  EXPECT_EQ(moved({{50 * kVertices, 1}, {3 * kVertices, kVertices}, {3 * kVertices + 5, 2}}), 2u);
  EXPECT_EQ(moved({{0, static_cast<std::uint32_t>(scene.vertices.size())}}), kBlocks);

  scene.vertices[50 * kVertices + 1].position.y = 1000;
  EXPECT_EQ(moved({{50 * kVertices + 1, 1}}), 1u);
  EXPECT_EQ(extents.core().outer, std::vector<std::uint32_t>{50 * SceneExtents::kBlockTriangles});
  EXPECT_EQ(extents.bounds().high.y, 1000);
  scene.vertices[50 * kVertices + 1].position.y = 0;
  EXPECT_EQ(moved({{50 * kVertices + 1, 1}}), 1u);
  EXPECT_TRUE(extents.core().outer.empty());
  EXPECT_EQ(extents.bounds().high.y, 0);
}

TEST(SceneExtents, UnusedVerticesCountForNothing) {
  Scene scene = rows(300);
  scene.vertices.push_back({.position = vec3(1e6f)});
  SceneExtents extents(scene);
  const auto unused = static_cast<std::uint32_t>(scene.vertices.size() - 1);
  scene.vertices[unused].position = vec3(-1e6f);
  EXPECT_EQ(extents.update(scene, std::vector<VertexRange>{{unused, 1}}), 0u);
  EXPECT_LT(extents.bounds().diagonal(), 100);
  expectExtentsOf(extents, scene);
}

TEST(SceneExtents, EmptyScenesAreEmpty) {
  EXPECT_TRUE(SceneExtents().bounds().empty());
  Scene scene;
  SceneExtents extents(scene);
  EXPECT_TRUE(extents.bounds().empty());
  EXPECT_TRUE(extents.core().bounds.empty());
  scene.vertices.resize(4);
  extents = SceneExtents(scene);
  EXPECT_EQ(extents.update(scene, std::vector<VertexRange>{{0, 4}}), 0u);
  expectExtentsOf(extents, scene);
}

}  // namespace
}  // namespace halfsilver
