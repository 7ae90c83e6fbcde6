// Rays on the CPU, without GL: packets, ties and the threads that trace.
#include <gtest/gtest.h>

#if HALFSILVER_EXACT

#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "exact/embree_scene.h"
#include "exact/worker_pool.h"

namespace halfsilver {
namespace {

using shared::Hit;
using shared::Ray;

void addTriangle(Scene& scene, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, std::uint32_t material) {
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  for (const glm::vec3& corner : {a, b, c}) scene.vertices.push_back({.position = corner});
  scene.triangles.push_back({{first, first + 1, first + 2}, material});
}

// Small triangles at random above the ground, single- and double-sided.
Scene soup() {
  Scene scene;
  scene.materials.resize(2);
  scene.materials[1].doubleSided = true;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-2, 2), size(-0.3f, 0.3f);
  for (std::uint32_t i = 0; i < 500; ++i) {
    const glm::vec3 at(place(random), 3 + place(random), place(random));
    const auto corner = [&] { return at + glm::vec3(size(random), size(random), size(random)); };
    const glm::vec3 a = corner(), b = corner(), c = corner();
    addTriangle(scene, a, b, c, i % 2);
  }
  return scene;
}

// Rays from a floor, those of neighbors nearly parallel, and each excludes some triangle.
std::vector<Ray> bundle(std::size_t count) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = static_cast<float>(i % 64) / 32 - 1, z = static_cast<float>(i / 64) / 32 - 1;
    rays.push_back(
        {{x, 0, z}, FAR_AWAY, glm::normalize(glm::vec3(0.3f * x, 1, 0.3f * z)), static_cast<std::uint32_t>(i % 500)});
  }
  return rays;
}

std::vector<Hit> traced(const Scene& scene, const std::vector<Ray>& rays, std::size_t atOnce, bool any = false) {
  EmbreeScene embree(scene, 1);
  embree.build();
  std::vector<Hit> hits(rays.size());
  for (std::size_t i = 0; i < rays.size(); i += atOnce) {
    const std::size_t count = std::min(atOnce, rays.size() - i);
    embree.trace(std::span(rays).subspan(i, count), {.minDistance = 1e-4f, .any = any},
                 std::span(hits).subspan(i, count));
  }
  return hits;
}

bool sameBits(const std::vector<Hit>& a, const std::vector<Hit>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Hit)) == 0;
}

TEST(ExactRays, PacketsGiveTheBitsOfSingleRays) {
  const Scene scene = soup();
  const std::vector<Ray> rays = bundle(64 * 64 + 5);
  const std::vector<Hit> single = traced(scene, rays, 1);
  std::size_t hits = 0;
  for (const Hit& hit : single) hits += hit.t >= 0;
  EXPECT_GT(hits, rays.size() / 4);
  EXPECT_LT(hits, rays.size());
  for (const std::size_t atOnce : {8u, 13u, 1024u}) EXPECT_TRUE(sameBits(single, traced(scene, rays, atOnce)));
}

TEST(ExactRays, AnyHitIsThereWhereTheNearestOneIs) {
  const Scene scene = soup();
  const std::vector<Ray> rays = bundle(2048);
  const std::vector<Hit> nearest = traced(scene, rays, 1024), any = traced(scene, rays, 1024, true);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(nearest[i].t >= 0, any[i].t >= 0);
    EXPECT_LE(nearest[i].t, any[i].t);
  }
}

TEST(ExactRays, OfTrianglesAtOneDistanceTheLowestNumberIsHit) {
  // Three copies of a triangle among others, which the hierarchy orders as it likes.
  Scene scene = soup();
  for (int copy = 0; copy < 3; ++copy) addTriangle(scene, {-3, 0.1f, -3}, {3, 0.1f, -3}, {0, 0.1f, 6}, 1);
  std::vector<Ray> rays = bundle(64 * 32);
  for (Ray& ray : rays) ray.excluded = 500;
  for (const std::size_t atOnce : {1u, 512u})
    for (const Hit& hit : traced(scene, rays, atOnce)) EXPECT_EQ(hit.triangle, 501u);
}

// Things of 25 triangles that move by a little or far, all of them together at times, and now and then are turned over.
TEST(ExactRays, AfterAnyMovesHitsAreThoseOfAFreshScene) {
  Scene scene = soup();
  const std::vector<Ray> rays = bundle(2048);
  EmbreeScene embree(scene, 1);
  embree.build();
  std::mt19937 random(3);
  std::uniform_real_distribution<float> small(-0.1f, 0.1f), large(-2, 2);
  std::vector<Hit> last(rays.size());
  std::size_t different = 0;
  for (int move = 0; move < 50; ++move) {
    SCOPED_TRACE(move);
    std::vector<VertexRange> moved;
    for (std::uint32_t thing = 0; thing < 20; ++thing) {
      if (random() % 8 && move != 30) continue;
      if (thing > static_cast<std::uint32_t>(move)) continue;  // the others start to move later
      const VertexRange range{75 * thing, 75};
      auto& by = random() % 4 ? small : large;
      const glm::vec3 shift(by(random), 0.5f * by(random), by(random));
      for (std::uint32_t v = range.first; v < range.first + range.count; ++v) scene.vertices[v].position += shift;
      if (random() % 4 == 0)
        for (std::uint32_t t = 25 * thing; t < 25 * (thing + 1); ++t)
          std::swap(scene.triangles[t].vertices[1], scene.triangles[t].vertices[2]);
      moved.push_back(range);
    }
    embree.follow(moved);
    for (const bool any : {false, true}) {
      std::vector<Hit> hits(rays.size());
      embree.trace(rays, {.minDistance = 1e-4f, .any = any}, hits);
      const std::vector<Hit> fresh = traced(scene, rays, 1024, any);
      if (any) {
        for (std::size_t i = 0; i < rays.size(); ++i) ASSERT_EQ(hits[i].t >= 0, fresh[i].t >= 0);
      } else {
        ASSERT_TRUE(sameBits(hits, fresh));
        different += !sameBits(hits, last);
        last = hits;
      }
    }
  }
  EXPECT_GT(different, 40u);
}

TEST(ExactRays, MemoryStaysTheSameAfterManyMoves) {
  Scene scene = soup();
  EmbreeScene embree(scene, 1);
  embree.build();
  std::uint64_t settled = 0;
  for (int move = 0; move < 40; ++move) {
    for (std::uint32_t v = 0; v < 150; ++v) scene.vertices[v].position.y += 0.01f;
    embree.follow(std::vector{VertexRange{0, 150}});
    if (move == 20) settled = embree.bytes();
  }
  EXPECT_GT(settled, 0u);
  EXPECT_LE(embree.bytes(), settled);
}

TEST(WorkerPool, EveryChunkOfEveryJobIsDoneOnce) {
  std::array<std::atomic<int>, 100> done[3] = {};
  WorkerPool pool(3);
  std::vector<std::shared_ptr<const WorkerPool::Job>> jobs;
  for (auto& counts : done) jobs.push_back(pool.start(counts.size(), [&counts](std::size_t i) { ++counts[i]; }));
  for (std::size_t job = jobs.size(); job-- > 0;) {
    pool.wait(*jobs[job]);
    for (const std::atomic<int>& count : done[job]) EXPECT_EQ(count, 1);
    EXPECT_GE(jobs[job]->milliseconds(), 0);
  }
  const auto none = pool.start(0, [](std::size_t) { FAIL(); });
  pool.wait(*none);
}

}  // namespace
}  // namespace halfsilver

#endif
