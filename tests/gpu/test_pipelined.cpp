// The hybrids of a CPU that traces one frame while the GPU draws the next: the same pictures, one frame later.
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "gpu/light_fixture.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

constexpr int kFrames = 60, kWidth = 96, kHeight = 72;

struct System {
  const char* name;  // of its preset
  std::vector<std::pair<const char*, const char*>> settings;
};

class PipelinedFrames : public TracingTest, public ::testing::WithParamInterface<System> {
 protected:
  std::vector<std::uint8_t> shown() const {
    std::vector<std::uint8_t> picture(std::size_t{4} * kWidth * kHeight);
    color_.read(GL_RGBA, GL_UNSIGNED_BYTE, picture.size(), picture.data());
    return picture;
  }
  Target target() const {
    framebuffer_.attach(GL_COLOR_ATTACHMENT0, color_);
    return {framebuffer_.name(), 0, 0, kWidth, kHeight};
  }

  gl::Texture color_{api, {.format = GL_RGBA8, .width = kWidth, .height = kHeight}, "test picture"};
  gl::Framebuffer framebuffer_{api};
};

Camera onItsWay(int frame) {
  const float angle = 0.05f * static_cast<float>(frame);
  return lookAt({3.2f * std::sin(angle), 1.9f, 3.2f * std::cos(angle)}, {0, 0.1f, 0});
}

TEST_P(PipelinedFrames, SixtyAreThoseThatFollowEachOtherOneLater) {
  Scene scene = soup(150);
  scene.lights = {sun({-0.3f, -1, -0.4f}, 2)};
  Settings wanted = settingsWith({{"trace.method", "exact"}, {"shadow.sky_directions", "2"}});
  for (const auto& [name, value] : GetParam().settings) set(wanted, name, value);
  Renderer inTurn = makeRenderer(scene), ahead = makeRenderer(scene);
  std::vector<std::uint8_t> last;
  ahead.begin(onItsWay(0), wanted, kWidth, kHeight);
  for (int frame = 1; frame <= kFrames; ++frame) {
    inTurn.render(onItsWay(frame - 1), wanted, target());
    const std::vector<std::uint8_t> expected = shown();
    const FrameReport report = inTurn.report();
    EXPECT_GT(report.selected, 300u);
    ahead.begin(onItsWay(frame), wanted, kWidth, kHeight);
    ahead.finish(target());
    ASSERT_TRUE(shown() == expected) << "frame " << frame;
    EXPECT_EQ(ahead.report().rays, report.rays);
    EXPECT_EQ(ahead.report().interpolated, report.interpolated);
    EXPECT_FALSE(expected == last) << "the camera moves";
    last = expected;
  }
  ahead.finish(target());
}

INSTANTIATE_TEST_SUITE_P(
    Systems, PipelinedFrames,
    ::testing::Values(System{"beck2005", {{"shadow.method", "refined"}}},
                      System{"robert2007", {{"primary.hits", "tested"}, {"trace.bounces", "3"}}},
                      System{"robert2007_interleaved", {{"primary.every", "2"}, {"trace.bounces", "3"}}},
                      System{"robert2007_refracting",
                             {{"primary.hits", "tested"}, {"trace.effect", "whitted"}, {"trace.bounces", "3"}}}),
    [](const auto& system) { return std::string(system.param.name); });

}  // namespace
}  // namespace halfsilver::testing
