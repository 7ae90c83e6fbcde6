// How often a frame of the identity method makes the host wait for the GPU. The count does not depend on the device.
#include <functional>
#include <memory>
#include <vector>

#include <halfsilver/tracer.h>
#include "gpu/binding_audit.h"
#include "gpu/shader_function.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

class HostWaits : public TracingTest {
 protected:
  Renderer makeCounting(const Scene& scene) {
    Renderer renderer(
        [this](const char* name) { return context.getProcAddress()(name); },
        std::vector<Method>{{methodInfo("identity"), [this](const gl::Api& table, const Settings& settings) {
                               waits_ = table.hostWaits;
                               return makeTracer(table, settings, {});
                             }}});
    renderer.setScene(scene);
    return renderer;
  }

  struct Counted {
    std::uint64_t waits;  // of the frame itself; reports and layers wait besides
    Frame frame;
  };

  Counted draw(Renderer& renderer, const Camera& camera, const Settings& settings) {
    const gl::Texture color(api, {.format = GL_RGBA8, .width = 80, .height = 60}, "test picture");
    const gl::Framebuffer framebuffer(api);
    framebuffer.attach(GL_COLOR_ATTACHMENT0, color);
    const std::uint64_t before = waits_ ? *waits_ : 0;
    renderer.render(camera, settings, {framebuffer.name(), 0, 0, 80, 60});
    const std::uint64_t waits = *waits_ - before;
    return {waits, {renderer.readLayers(), renderer.report()}};
  }

  // The same frame once more: nothing is waited for, and nothing differs.
  Counted expectStill(Renderer& renderer, const Camera& camera, const Settings& settings, const Counted& before) {
    Counted still = draw(renderer, camera, settings);
    EXPECT_EQ(still.waits, 0u);
    EXPECT_EQ(still.frame.layers.data, before.frame.layers.data);
    return still;
  }

  std::shared_ptr<std::uint64_t> waits_;
  std::unique_ptr<gl::Api> table_;
  bool likeHardware_ = false;  // loops are not limited
};

TEST_F(HostWaits, AFrameThatBuildsWaitsTwiceAtMostAndAStillOneNever) {
  Scene scene = soup(3000);
  const Settings settings = settingsWith({{"trace.method", "identity"}});
  Renderer renderer = makeCounting(scene);
  const Counted first = draw(renderer, kAbove, settings);
  EXPECT_GE(first.waits, 1u);
  EXPECT_LE(first.waits, 2u);
  EXPECT_GT(first.frame.report.selected, 500u);
  for (int i = 0; i < 2; ++i) {
    const Counted still = draw(renderer, kAbove, settings);
    EXPECT_EQ(still.waits, 0u);
    EXPECT_EQ(still.frame.layers.data, first.frame.layers.data);
    EXPECT_EQ(still.frame.report.memory.fragments, first.frame.report.memory.fragments);
    EXPECT_EQ(still.frame.report.overflow, 0u);
  }

  const Camera other = lookAt({1.5f, 1.2f, 2.0f}, {0, 0.1f, 0});
  const Counted turned = draw(renderer, other, settings);
  EXPECT_GT(turned.frame.report.memory.fragments, first.frame.report.memory.fragments) << "it builds";
  EXPECT_LE(turned.waits, 2u);
  EXPECT_EQ(draw(renderer, other, settings).waits, 0u);

  const VertexRange ranges[] = {{30, 60}, {300, 60}, {600, 60}, {900, 60}};
  for (const VertexRange& range : ranges)
    for (std::uint32_t v = range.first; v < range.first + range.count; ++v) scene.vertices[v].position.y += 0.03f;
  renderer.updateVertices(scene, ranges);
  const Counted moved = draw(renderer, other, settings);
  EXPECT_GT(moved.frame.report.memory.fragments, turned.frame.report.memory.fragments) << "it builds";
  EXPECT_LE(moved.waits, 2u);
  EXPECT_EQ(moved.frame.layers.data, drawOnce(scene, other, settings, 80, 60).layers.data);
  expectStill(renderer, other, settings, moved);
}

// Without a limit on loops, rays wait for bricks alone.
TEST_F(HostWaits, AreAsFewIfTheDriverLetsLoopsRun) {
  likeHardware_ = true;
  const Scene scene = soup(1500);
  const Settings settings = settingsWith({{"trace.method", "identity"}});
  Renderer renderer = makeCounting(scene);
  const Counted first = draw(renderer, kAbove, settings);
  EXPECT_LE(first.waits, 2u);
  EXPECT_EQ(first.frame.layers.data, drawOnce(scene, kAbove, settings, 80, 60).layers.data);
  expectStill(renderer, kAbove, settings, first);
}

// Ranges that move are followed together: a hundred cost the dispatches and draws of one.
TEST_F(HostWaits, AndDispatchesDoNotGrowWithTheRangesThatMove) {
  const Settings settings = settingsWith({{"trace.method", "identity"}});
  const auto dispatches = [&](std::uint32_t count) {
    Scene scene = soup(3000);
    BindingAudit audit(context.getProcAddress());
    Renderer renderer(audit.getProcAddress());
    renderer.setScene(scene);
    drawWith(renderer, kAbove, settings, 80, 60);
    const std::size_t before = audit.checks("voxelize");
    std::vector<VertexRange> ranges;
    for (std::uint32_t i = 0; i < count; ++i) ranges.push_back({6 + 60 * i, 3});
    for (const VertexRange& range : ranges)
      for (std::uint32_t v = range.first; v < range.first + range.count; ++v) scene.vertices[v].position.y += 0.05f;
    renderer.updateVertices(scene, ranges);
    const Frame moved = drawWith(renderer, kAbove, settings, 80, 60);
    const std::size_t after = audit.checks("voxelize");
    EXPECT_EQ(moved.layers.data, drawOnce(scene, kAbove, settings, 80, 60).layers.data) << count;
    return after - before;
  };
  const std::size_t one = dispatches(1);
  EXPECT_GT(one, 0u);
  EXPECT_EQ(dispatches(100), one);
}

// Each generation of rays is known only when the one before it is through.
TEST_F(HostWaits, GrowWithTheBouncesOnlyWhileSomethingIsBuilt) {
  const Scene scene = soup(3000);
  const Settings settings = settingsWith({{"trace.method", "identity"}, {"trace.bounces", "3"}});
  Renderer renderer = makeCounting(scene);
  const Counted first = draw(renderer, kAbove, settings);
  EXPECT_LE(first.waits, 6u);
  expectStill(renderer, kAbove, settings, first);
}

// What rays need is more than a pool begins with.
TEST_F(HostWaits, StayTwoIfThePoolHasToGrow) {
  Scene scene;
  scene.materials = {mirrorMaterial(), plain({0.8f, 0.3f, 0.2f})};
  addQuad(scene, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, 0);
  for (int i = 0; i < 40; ++i) {
    const float y = 0.2f + 0.05f * static_cast<float>(i);
    addQuad(scene, {-2, y, -2}, {2, y, -2}, {2, y + 1, 2}, {-2, y + 1, 2}, 1);
  }
  const Settings settings = settingsWith({{"trace.method", "identity"},
                                          {"voxels.resolution", "64"},
                                          {"voxels.per_triangle", "0"},
                                          {"select.mode", "all"}});
  Renderer renderer = makeCounting(scene);
  const Counted first = draw(renderer, kAbove, settings);
  EXPECT_EQ(first.waits, 2u);
  EXPECT_GT(first.frame.report.memory.fragmentsStored, 65536u);
  EXPECT_EQ(first.frame.report.overflow, 0u);
  EXPECT_EQ(draw(renderer, kAbove, settings).waits, 0u);
}

}  // namespace
}  // namespace halfsilver::testing
