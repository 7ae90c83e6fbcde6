// What a frame asks of GL: calls, dispatches, and questions, which make a driver's threads wait. None of the counts
// depends on the device but for its limit on loops.
#include <vector>

#include "gpu/gl_call_counter.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

class GlCalls : public TracingTest {
 protected:
  GlCalls() : color_(api, {.format = GL_RGBA8, .width = 80, .height = 60}, "test picture"), framebuffer_(api) {
    framebuffer_.attach(GL_COLOR_ATTACHMENT0, color_);
    renderer_.setScene(scene_);
    renderer_.restoreState(false);
    for (int i = 0; i < 4; ++i) draw(kAbove);  // until each record of a frame has its memory
  }

  struct Calls {
    std::uint64_t all, dispatches, draws, questions, waits;
  };

  Calls draw(const Camera& camera) {
    counter_.reset();
    renderer_.render(camera, settings_, {framebuffer_.name(), 0, 0, 80, 60});
    // Whether there was memory for what is made, and how a program came out, is asked once for each.
    EXPECT_LE(counter_.of("GetError"), 2 * (counter_.of("CreateBuffers") + counter_.of("CreateTextures")));
    const std::uint64_t made = counter_.of("GetError") + counter_.of("GetUniformLocation") + counter_.of("GetProgram");
    const Calls calls{counter_.all(), counter_.of("DispatchCompute"), counter_.of("Draw") + counter_.of("MultiDraw"),
                      counter_.of("Get") + counter_.of("Is") - made, counter_.of("ClientWaitSync")};
    return calls;
  }

  Scene scene_ = soup(3000);
  const Settings settings_ = settingsWith({{"trace.method", "identity"}});
  GlCallCounter counter_{context.getProcAddress()};
  Renderer renderer_{counter_.getProcAddress()};
  const gl::Texture color_;
  const gl::Framebuffer framebuffer_;
};

TEST_F(GlCalls, AStillFrameAsksNothing) {
  const Calls still = draw(kAbove);
  EXPECT_EQ(still.questions, 0u);
  EXPECT_EQ(counter_.of("GetError"), 0u);
  EXPECT_EQ(still.waits, 0u);
  EXPECT_GT(still.draws, 0u);
  EXPECT_LE(still.dispatches, 16u);
  EXPECT_LE(still.all, 800u);
}

TEST_F(GlCalls, AFrameOfAWalkingCameraAsksWhatItsRaysNeedAndNothingElse) {
  Camera camera = kAbove;
  for (int step = 0; step < 4; ++step) {
    camera.eye.x += 0.05f;
    const Calls walking = draw(camera);
    EXPECT_EQ(walking.questions, 0u);
    EXPECT_LE(walking.waits, 2u);
    EXPECT_LE(walking.dispatches, 100u);
    EXPECT_LE(walking.all, 3000u);
  }
}

TEST_F(GlCalls, AFrameInWhichAHundredObjectsMoveDoesWhatOneOfOneDoes) {
  const auto moved = [&](std::uint32_t count) {
    std::vector<VertexRange> ranges;
    for (std::uint32_t i = 0; i < count; ++i) ranges.push_back({6 + 60 * i, 3});
    for (const VertexRange& range : ranges)
      for (std::uint32_t v = range.first; v < range.first + range.count; ++v) scene_.vertices[v].position.y += 0.02f;
    renderer_.updateVertices(scene_, ranges);
    return draw(kAbove);
  };
  moved(1);
  const Calls one = moved(1), hundred = moved(100);
  for (const Calls& calls : {one, hundred}) {
    EXPECT_EQ(calls.questions, 0u);
    EXPECT_LE(calls.waits, 2u);
    EXPECT_LE(calls.draws, 20u);
    EXPECT_LE(calls.dispatches, 100u);
    EXPECT_LE(calls.all, 3000u);
  }
}

// What the caller is spared by saying that he keeps no state.
TEST_F(GlCalls, KeepingTheCallersStateAsksForAllOfIt) {
  renderer_.restoreState(true);
  EXPECT_GT(draw(kAbove).questions, 300u);
}

}  // namespace
}  // namespace halfsilver::testing
