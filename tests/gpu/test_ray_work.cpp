// What searches count of each ray.
#include <numeric>
#include <string>

#include <halfsilver/error.h>
#include "gpu/small_blocks.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

class RayWorkTest : public TracingTest, public ::testing::WithParamInterface<const char*> {
 protected:
  static Settings settings(const char* count) {
    return settingsWith({{"trace.method", GetParam()}, {"voxels.resolution", "32"}, {"trace.count_work", count}});
  }
};

TEST_P(RayWorkTest, IsCountedForEachRayAndChangesNoHit) {
  const Scene scene = soup(600);
  Renderer renderer = makeRenderer(scene);
  const Frame without = drawWholeWith(renderer, kAbove, settings("false"), 80, 60);
  EXPECT_TRUE(renderer.readRayWork().empty());
  const Frame with = drawWholeWith(renderer, kAbove, settings("true"), 80, 60);
  for (const std::string& channel : without.layers.channels)
    EXPECT_EQ(with.plane(channel), without.plane(channel)) << channel;
  const std::vector<RayWork> work = renderer.readRayWork();
  ASSERT_EQ(work.size(), with.report.selected);
  ASSERT_GT(work.size(), 500u);
  double steps = 0, tests = 0;
  for (const RayWork& ray : work) {
    EXPECT_GT(ray.steps, 0u);
    steps += ray.steps;
    tests += ray.tests;
  }
  // The layers say the same, pixel by pixel.
  const auto sumOf = [](const std::vector<float>& plane) { return std::accumulate(plane.begin(), plane.end(), 0.0); };
  EXPECT_EQ(sumOf(with.plane("work.steps")), steps);
  EXPECT_EQ(sumOf(with.plane("work.tests")), tests);
  const std::vector<float> selected = with.plane("selected.Y"), counted = with.plane("work.steps");
  for (std::size_t pixel = 0; pixel < selected.size(); ++pixel) ASSERT_EQ(counted[pixel] > 0, selected[pixel] > 0);
  const auto rays = static_cast<double>(work.size());
  EXPECT_GT(steps / rays, 2);
  EXPECT_LT(steps / rays, 100);
  EXPECT_GT(tests / rays, 0.5);
  EXPECT_LT(tests / rays, 100);
  // Another frame counts from zero.
  drawWith(renderer, kAbove, settings("true"), 80, 60);
  const auto total = [](const std::vector<RayWork>& of) {
    return std::accumulate(of.begin(), of.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const RayWork& ray) { return sum + ray.tests; });
  };
  EXPECT_LE(total(renderer.readRayWork()), total(work));
}

TEST_P(RayWorkTest, IsRefusedIfItIsNotThatOfAllRaysOfTheFrame) {
  const Scene scene = soup(50);
  Renderer renderer(withSmallBlocks(context.getProcAddress()), methods(scene));
  renderer.setScene(scene);
  const auto refusal = [&renderer]() -> std::string {
    try {
      EXPECT_FALSE(renderer.readRayWork().empty());
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      return error.what();
    }
    return "none";
  };
  const Settings wanted = settings("true");
  drawWith(renderer, kAbove, wanted, 40, 30);
  EXPECT_EQ(refusal(), "none");

  Settings bounces = wanted;
  bounces.trace.bounces = 2;
  drawWith(renderer, kAbove, bounces, 40, 30);
  EXPECT_EQ(refusal(), "readRayWork() needs a frame of one bounce whose rays come in one batch");
  drawWith(renderer, kAbove, wanted, 512, 384);
  EXPECT_EQ(refusal(), "readRayWork() needs a frame of one bounce whose rays come in one batch");

  drawWith(renderer, kAbove, wanted, 40, 30);
  EXPECT_EQ(refusal(), "none");
  renderer.begin(kAbove, wanted, 40, 30);
  EXPECT_NE(refusal(), "none") << "the tracer may hold the work of the frame under way";
}

INSTANTIATE_TEST_SUITE_P(CountingMethods, RayWorkTest, ::testing::Values("identity", "bvh", "attributes"),
                         [](const auto& method) { return std::string(method.param); });

TEST_F(TracingTest, ExactRaysAreNotCounted) {
  const Scene scene = soup(50);
  Renderer renderer = makeRenderer(scene);
  drawWith(renderer, kAbove, settingsWith({{"trace.method", "exact"}, {"trace.count_work", "true"}}), 40, 30);
  EXPECT_TRUE(renderer.readRayWork().empty());
}

}  // namespace
}  // namespace halfsilver::testing
