// Distances of rays: trace() finds nothing beyond a ray's largest distance, and occluded() says whether it would find
// something.
#include <cmath>
#include <random>
#include <string>

#include "frame/frame_constants.h"
#include "frame/gpu_scene.h"
#include "gpu/ray_queues.h"
#include "gpu/shader_function.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

using shared::Hit;
using shared::Ray;

struct DistanceCase {
  const char* method;
  float undecided;  // meters around the largest distance in which a hit may be answered either way: a search that is
                    // cut short in a voxel takes other steps
};

// A soup with a leaf that has holes and a wall that is seen from one side only.
Scene sieve() {
  Scene scene = soup(800);
  auto checks = plainTexture(8, 8, {200, 120, 40, 255}, true);
  for (std::size_t i = 0; i < 64; ++i)
    if (((i % 8) / 2 + i / 16) % 2 == 0) checks->texels[4 * i + 3] = 0;
  scene.textures = {checks};
  Material leaf = plain({1, 1, 1});
  leaf.alphaMode = AlphaMode::mask;
  leaf.doubleSided = true;
  leaf.baseColorTexture.texture = 0;
  scene.materials.push_back(leaf);
  scene.materials.push_back(plain({0, 1, 0}));
  addQuad(scene, {-2, 0, -0.5f}, {2, 0, -0.5f}, {2, 1.5f, -0.5f}, {-2, 1.5f, -0.5f}, 2);
  addQuad(scene, {-2, 0, 0.5f}, {2, 0, 0.5f}, {2, 1.5f, 0.5f}, {-2, 1.5f, 0.5f}, 3);
  return scene;
}

class RayDistances : public ContextTest, public ::testing::WithParamInterface<DistanceCase> {
 protected:
  RayDistances() {
    set(settings_, "trace.method", GetParam().method);
    const Method exact{methodInfo("exact"), makeExactTracerFactory(scene_, 2)};
    tracer_ = makeTracer(api, settings_, std::span(&exact, 1));
    frame_ = makeFrameConstants(kAbove, gpu_.extents.bounds(), scene_.sky, settings_, 16, 16, {});
    constants_ = gl::makeBuffer(api, std::span<const shared::FrameConstants>(&frame_, 1), "frame");
    // Structures whose pool grows from frame to frame are whole after a few.
    for (int i = 0; i < 4; ++i) tracer_->update(view(), SceneChange::everything());
  }

  FrameView view() { return {gpu_, unshadowed_, constants_, frame_, profiler_, gbuffer_}; }

  // From anywhere in the scene to anywhere; some start on a triangle.
  std::vector<Ray> randomRays(std::size_t count) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(-1, 1);
    const auto triangles = static_cast<std::uint32_t>(scene_.triangles.size());
    std::vector<Ray> rays;
    while (rays.size() < count) {
      const glm::vec3 origin(1.9f * unit(random), 0.8f + 0.7f * unit(random), 1.9f * unit(random));
      const glm::vec3 direction(unit(random), unit(random), unit(random));
      if (glm::length(direction) < 0.1f) continue;
      const std::uint32_t excluded =
          rays.size() % 3 == 0 ? static_cast<std::uint32_t>(random()) % triangles : NO_TRIANGLE;
      rays.push_back({origin, FAR_AWAY, glm::normalize(direction), excluded});
    }
    return rays;
  }

  std::vector<Hit> trace(const std::vector<Ray>& rays) {
    return answer(rays, [this](const RayQueue& queue, Hits& hits) { tracer_->trace(view(), queue, hits); });
  }
  std::vector<Hit> occluded(const std::vector<Ray>& rays) {
    return answer(rays, [this](const RayQueue& queue, Hits& hits) { tracer_->occluded(view(), queue, hits); });
  }

 private:
  template <class Query>
  std::vector<Hit> answer(const std::vector<Ray>& rays, const Query& query) {
    const RayQueue queue = makeQueue(api, rays);
    Hits hits;
    hits.hits = gl::Buffer(api, rays.size() * sizeof(Hit), "hits");
    if (tracer_->storesAttributes())
      hits.surfaces = gl::Buffer(api, rays.size() * sizeof(shared::HitSurface), "hit surfaces");
    query(queue, hits);
    api.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    EXPECT_EQ(queue.count.read<shared::RayCount>(1)[0].overflow, 0u);
    return hits.hits.read<Hit>(rays.size());
  }

  Settings settings_;
  const Scene scene_ = sieve();
  GpuScene gpu_ = uploadScene(api, scene_);
  ShadowMaps unshadowed_;
  shared::FrameConstants frame_{};
  gl::Buffer constants_;
  gl::Profiler profiler_{api};
  const GBuffer gbuffer_;  // no ray starts there
  std::unique_ptr<Tracer> tracer_;
};

TEST_P(RayDistances, OccludedMeansAHitWithinTheLargestDistance) {
  std::vector<Ray> rays = randomRays(6000);
  const std::vector<Hit> nearest = trace(rays);
  std::mt19937 random(4);
  std::uniform_real_distribution<float> distance(0.01f, 3);
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (i % 4 != 0) rays[i].maxDistance = distance(random);
  const std::vector<Hit> within = trace(rays), any = occluded(rays);

  std::size_t blocked = 0, beyond = 0, free = 0, notNearest = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool expected = nearest[i].t >= 0 && nearest[i].t <= rays[i].maxDistance;
    ++(expected ? blocked : nearest[i].t >= 0 ? beyond : free);
    EXPECT_EQ(any[i].t >= 0, within[i].t >= 0) << i;
    if (std::abs(nearest[i].t - rays[i].maxDistance) <= GetParam().undecided) continue;
    EXPECT_EQ(within[i].triangle, expected ? nearest[i].triangle : NO_TRIANGLE) << i;
    if (!expected) {
      EXPECT_EQ(within[i].t, HIT_MISS) << i;
      EXPECT_EQ(any[i].t, HIT_MISS) << i;
      EXPECT_EQ(any[i].triangle, NO_TRIANGLE) << i;
      continue;
    }
    EXPECT_LE(any[i].t, rays[i].maxDistance) << i;
    EXPECT_GE(any[i].t, nearest[i].t) << i;
    EXPECT_NE(any[i].triangle, rays[i].excluded) << i;
    EXPECT_LT(any[i].triangle, NO_TRIANGLE) << i;
    notNearest += any[i].triangle != nearest[i].triangle;
  }
  EXPECT_GT(blocked, 1500u);
  EXPECT_GT(beyond, 500u);
  EXPECT_GT(free, 500u);
  if (GetParam().method == std::string("exact")) {
    EXPECT_GT(notNearest, 50u) << "the search for any hit must end at the first it finds";
  }
}

TEST_P(RayDistances, HitsEndJustBeyondTheLargestDistance) {
  std::vector<Ray> rays;
  std::vector<Hit> nearest;
  {
    const std::vector<Ray> all = randomRays(6000);
    const std::vector<Hit> hits = trace(all);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (hits[i].t > 0.05f) {
        rays.push_back(all[i]);
        nearest.push_back(hits[i]);
      }
  }
  ASSERT_GT(rays.size(), 2500u);
  const auto limited = [&](float side) {
    std::vector<Ray> result = rays;
    for (std::size_t i = 0; i < rays.size(); ++i)
      result[i].maxDistance = nearest[i].t + side * (1e-4f * nearest[i].t + GetParam().undecided);
    return result;
  };
  const std::vector<Hit> below = trace(limited(-1)), above = trace(limited(1));
  const std::vector<Hit> blockedBelow = occluded(limited(-1)), blockedAbove = occluded(limited(1));
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(below[i].t, HIT_MISS) << i;
    EXPECT_EQ(blockedBelow[i].t, HIT_MISS) << i;
    EXPECT_EQ(above[i].t, nearest[i].t) << i;
    EXPECT_EQ(above[i].triangle, nearest[i].triangle) << i;
    EXPECT_GE(blockedAbove[i].t, 0) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(AllMethods, RayDistances,
                         ::testing::Values(DistanceCase{"exact", 0}, DistanceCase{"identity", 0},
                                           DistanceCase{"bvh", 0}, DistanceCase{"attributes", 0.014f}),
                         [](const auto& method) { return std::string(method.param.method); });

}  // namespace
}  // namespace halfsilver::testing
