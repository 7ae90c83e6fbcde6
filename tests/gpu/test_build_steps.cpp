// The two steps of a build, if a compiler makes them disagree: what is there stays whole, and nothing is hit that is
// not there.
#include <string>

#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

using BuildSteps = TracingTest;

// Bricks that rays from above need are built as they should be, those of another view by edited shaders.
TEST_F(BuildSteps, StoringMoreThanWasCountedWritesIntoNoOtherRun) {
  const std::string add = "atomicAdd(builds[build].next[voxelInBrick(voxel)], 1u)";
  const Scene scene = soup(3000);
  const Settings settings = settingsWith({{"trace.method", "identity"}});
  const Camera other = lookAt({1.5f, 1.2f, 2.0f}, {0, 0.1f, 0});
  const Frame exact = drawOnce(scene, other, settings, 80, 60);
  Renderer renderer = makeRenderer(scene);
  const Frame before = drawWith(renderer, kAbove, settings, 80, 60);
  std::size_t differ = 0;
  withShaders(
      {{"tracing/identity/add_entry.glsl", add, "secondStep == 0 && (triangle & 1u) == 1u ? 0u : " + add}, kInSteps},
      [&] {
        ASSERT_TRUE(renderer.reloadShaders().empty());
        const Frame broken = drawWith(renderer, other, settings, 80, 60);
        EXPECT_GT(broken.report.memory.fragments, before.report.memory.fragments) << "it builds";
        const std::vector<float> found = broken.plane("hit.T"), right = exact.plane("hit.T"),
                                 ids = broken.plane("hit.id");
        for (std::size_t i = 0; i < found.size(); ++i) {
          differ += found[i] != right[i];
          EXPECT_LT(ids[i], static_cast<float>(scene.triangles.size()));
          if (found[i] >= 0 && right[i] >= 0) {
            EXPECT_GE(found[i], right[i]) << "pixel " << i;
          }
        }
      });
  EXPECT_GT(differ, 0u) << "the edit must matter";
  EXPECT_EQ(drawWith(renderer, kAbove, settings, 80, 60).layers.data, before.layers.data)
      << "what was built before is as it was";
}

}  // namespace
}  // namespace halfsilver::testing
