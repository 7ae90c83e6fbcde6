// trace.method=auto: what is measured, and what is chosen.
#include <algorithm>
#include <string>
#include <vector>

#include <halfsilver/calibration.h>
#include <halfsilver/error.h>
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

class CalibrationTest : public TracingTest {
 protected:
  std::vector<Method> methods(const Scene& scene) const override {
    return withExact_ ? TracingTest::methods(scene) : std::vector<Method>{};
  }

  MethodChoice choose(const Scene& scene, std::string_view present = {}, std::function<void(int)> advance = {}) {
    Renderer renderer = makeRenderer(scene);
    const gl::Texture picture(api, {.format = GL_RGBA8, .width = 64, .height = 48}, "test picture");
    const gl::Framebuffer framebuffer(api);
    framebuffer.attach(GL_COLOR_ATTACHMENT0, picture);
    return chooseMethod(renderer, {.camera = kAbove,
                                   .settings = settingsWith({{"trace.method", "auto"}}),
                                   .target = {framebuffer.name(), 0, 0, 64, 48},
                                   .present = present,
                                   .advance = std::move(advance)});
  }

  bool withExact_ = true;
};

TEST_F(CalibrationTest, OnASoftwareRasterizerRaysOfTheCpuNeedNoMeasurement) {
  if (!api.software) GTEST_SKIP() << "this device is hardware";
  const MethodChoice choice = choose(soup(50));
  EXPECT_EQ(choice.method, "exact");
  EXPECT_TRUE(choice.measured.empty());
  EXPECT_NE(choice.reason.find("software"), std::string::npos);
}

TEST_F(CalibrationTest, WithoutThemTheFastestMethodWithoutErrorsIsChosen) {
  withExact_ = false;
  const MethodChoice choice = choose(soup(400));
  std::vector<std::string> measured;
  for (const MethodTime& time : choice.measured) {
    measured.push_back(time.method);
    EXPECT_GT(time.milliseconds, 0);
  }
  EXPECT_EQ(measured, (std::vector<std::string>{"identity", "bvh"}));
  const auto fastest =
      std::min_element(choice.measured.begin(), choice.measured.end(),
                       [](const MethodTime& a, const MethodTime& b) { return a.milliseconds < b.milliseconds; });
  EXPECT_EQ(choice.method, fastest->method);
  EXPECT_NE(choice.reason.find(fastest->method), std::string::npos) << choice.reason;
}

TEST_F(CalibrationTest, WhatIsInUseStaysUnlessAnotherIsClearlyFaster) {
  withExact_ = false;
  for (const char* present : {"identity", "bvh"}) {
    const MethodChoice choice = choose(soup(400), present);
    double own = 0, best = 1e9;
    for (const MethodTime& time : choice.measured) {
      if (time.method == present) own = time.milliseconds;
      best = std::min(best, time.milliseconds);
    }
    EXPECT_EQ(choice.method == present, own <= kMethodHysteresis * best) << choice.reason;
  }
}

TEST_F(CalibrationTest, WhatMovesMovesBeforeEachMeasuredFrame) {
  withExact_ = false;
  std::vector<int> steps;
  choose(soup(50), {}, [&steps](int step) { steps.push_back(step); });
  ASSERT_GE(steps.size(), 2u);
  // Each candidate takes the same ones.
  EXPECT_EQ(std::count(steps.begin(), steps.end(), 0), 2);
  for (std::size_t i = 0; i < steps.size(); ++i) EXPECT_EQ(steps[i], steps[i] == 0 ? 0 : steps[i - 1] + 1);
}

}  // namespace
}  // namespace halfsilver::testing
