// Exact rays in the frame: what they make it wait for.
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

TEST_F(TracingTest, ExactRaysWaitOncePerFrameWhileTheirNumberLasts) {
  const Scene scene = soup(100);
  std::shared_ptr<std::uint64_t> waits;
  const auto make = [&waits, exact = makeExactTracerFactory(scene, 2)](const gl::Api& gl, const Settings& settings) {
    waits = gl.hostWaits;
    return exact(gl, settings);
  };
  Renderer renderer([this](const char* name) { return context.getProcAddress()(name); }, {{methodInfo("exact"), make}});
  renderer.setScene(scene);
  const gl::Texture color(api, {.format = GL_RGBA8, .width = 80, .height = 60}, "test picture");
  const gl::Framebuffer framebuffer(api);
  framebuffer.attach(GL_COLOR_ATTACHMENT0, color);
  const Settings settings = settingsWith({{"trace.method", "exact"}});
  std::vector<std::uint64_t> counts;
  for (int i = 0; i < 3; ++i) {
    const std::uint64_t before = waits ? *waits : 0;
    renderer.render(kAbove, settings, {framebuffer.name(), 0, 0, 80, 60});
    counts.push_back(*waits - before);
  }
  EXPECT_GT(renderer.report().selected, 500u);
  EXPECT_EQ(counts, (std::vector<std::uint64_t>{2, 1, 1}));
}

}  // namespace
}  // namespace halfsilver::testing
