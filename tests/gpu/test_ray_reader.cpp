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

TEST_F(RayReaderTest, StoredRaysComeBackAsTheyAre) {
  const std::vector<Ray> rays = randomRays(1000);
  const RayQueue queue = makeQueue(api, rays);
  RayReader reader(api);
  EXPECT_TRUE(reader.rays().empty());
  reader.submit(view(), queue, 1000);
  expectSame(reader.rays(), rays);
  EXPECT_TRUE(reader.ready());
  reader.submit(view(), queue, 77);
  expectSame(reader.rays(), std::span(rays).first(77));
  reader.submit(view(), queue, 5000);
  EXPECT_EQ(reader.rays().size(), 1000u) << "a queue holds no more";
  reader.submit(view(), queue, 0);
  EXPECT_TRUE(reader.rays().empty());
}

TEST_F(RayReaderTest, MoreRaysThanAStorageBlockHoldsComeInSlices) {
  const std::vector<Ray> rays = randomRays(1000);
  const RayQueue queue = makeQueue(api, rays);
  gl::Api small = api;
  small.limits.storageBlockBytes = 200 * sizeof(Ray);
  RayReader reader(small);
  reader.submit(view(), queue, 1000);
  expectSame(reader.rays(), rays);
  EXPECT_GT(static_cast<GLint64>(reader.bytes()), small.limits.storageBlockBytes);
}

}  // namespace
}  // namespace halfsilver::testing
