// Rays that the host reads are those that shaders load.
#include <random>

#include <halfsilver/ray_reader.h>
#include "gpu/context_fixture.h"
#include "gpu/ray_queues.h"

namespace halfsilver::testing {
namespace {

using shared::Ray;

class RayReaderTest : public ContextTest {
 protected:
  static std::vector<Ray> randomRays(std::size_t count) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
      ray.origin = {unit(random), unit(random), unit(random)};
      ray.maxDistance = 1 + unit(random);
      ray.direction = glm::normalize(glm::vec3(unit(random), unit(random), 2));
      ray.excluded = static_cast<std::uint32_t>(random());
    }
    return rays;
  }

  static void expectSame(std::span<const Ray> found, std::span<const Ray> expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(found[i].origin, expected[i].origin) << i;
      ASSERT_EQ(found[i].maxDistance, expected[i].maxDistance) << i;
      ASSERT_EQ(found[i].direction, expected[i].direction) << i;
      ASSERT_EQ(found[i].excluded, expected[i].excluded) << i;
    }
  }

  FrameView view() { return {scene_, shadows_, constants_, frame_, profiler_, gbuffer_}; }

  GpuScene scene_;
  ShadowMaps shadows_;
  const shared::FrameConstants frame_{};
  const gl::Buffer constants_ = gl::makeBuffer(api, std::span<const shared::FrameConstants>(&frame_, 1), "frame");
  gl::Profiler profiler_{api};
  GBuffer gbuffer_;
};

TEST_F(RayReaderTest, StoredRaysComeBackAsTheyAreHoweverManyWereLikely) {
  const std::vector<Ray> rays = randomRays(1000);
  const RayQueue queue = makeQueue(api, rays), none = makeQueue(api, std::vector<Ray>());
  RayReader reader(api);
  for (const std::uint32_t likely : {1000u, 77u, 0u, 5000u}) {
    reader.submit(view(), queue, likely);
    expectSame(reader.rays(view(), queue), rays);
  }
  EXPECT_TRUE(reader.ready());
  reader.submit(view(), none, 10);
  EXPECT_TRUE(reader.rays(view(), none).empty());
}

TEST_F(RayReaderTest, OneWaitIsEnoughIfNoMoreRaysAreThereThanWasLikely) {
  const RayQueue queue = makeQueue(api, randomRays(300));
  RayReader reader(api);
  for (const std::uint32_t likely : {300u, 299u}) {
    const std::uint64_t before = *api.hostWaits;
    reader.submit(view(), queue, likely);
    EXPECT_EQ(reader.rays(view(), queue).size(), 300u);
    EXPECT_EQ(*api.hostWaits - before, likely == 300 ? 1u : 2u);
  }
}

TEST_F(RayReaderTest, ReadersOfOneProgramKeepTheirOwnRays) {
  const std::vector<Ray> some = randomRays(100), more = randomRays(200);
  const RayQueue one = makeQueue(api, some), other = makeQueue(api, more);
  RayReader first(api), second = first.another();
  first.submit(view(), one, 100);
  second.submit(view(), other, 200);
  expectSame(second.rays(view(), other), more);
  expectSame(first.rays(view(), one), some);
}

TEST_F(RayReaderTest, MoreRaysThanAStorageBlockHoldsComeInSlices) {
  const std::vector<Ray> rays = randomRays(1000);
  const RayQueue queue = makeQueue(api, rays);
  gl::Api small = api;
  small.limits.storageBlockBytes = 200 * sizeof(Ray);
  RayReader reader(small);
  reader.submit(view(), queue, 1000);
  expectSame(reader.rays(view(), queue), rays);
  EXPECT_GT(static_cast<GLint64>(reader.bytes()), small.limits.storageBlockBytes);
}

}  // namespace
}  // namespace halfsilver::testing
