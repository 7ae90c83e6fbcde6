// What is too rough to be traced is looked for on the screen: select.max_roughness decides what a picture costs, not
// how it looks.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gpu/light_fixture.h"
#include "gpu/shader_function.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

using glm::vec3;

constexpr int kWidth = 160, kHeight = 90;
constexpr std::size_t kByScreen = 6;  // of FrameReport::rays

class GlossyScreenTest : public TracingTest {
 protected:
  inline static const ShaderEdit kAllTraced = {
      // nothing is left to the screen and to the sky
      "lib/fresnel.glsl", "return clamp(1.0 - roughness / frame.maxRoughness, 0.0, 1.0);", "return 1.0;"};
  inline static const ShaderEdit kSkyAlone = {"lib/blend.glsl", "if (frame.glossySamples != 0u)",
                                              "if (frame.glossySamples > 1000u)"};
  inline static const ShaderEdit kBoth = {"passes/shade.comp", "asksScreen = !goesOn", "asksScreen = false && !goesOn"};
  static Settings settings(float maxRoughness) {
    Settings result = settingsWith({{"effect.glossy", "true"}, {"effect.samples", "16"}});
    result.select.maxRoughness = maxRoughness;
    return result;
  }
};

// A metal floor whose roughness grows from 0 on the left to 1 on the right, before a bright wall.
Scene roughnessRamp() {
  Scene scene;
  auto ramp = plainTexture(256, 1, {0, 0, 255, 255}, false);
  for (std::size_t i = 0; i < 256; ++i) ramp->texels[4 * i + 1] = static_cast<std::uint8_t>(i);
  scene.textures = {ramp};
  Material floor = plain(vec3(0.8f));
  floor.metallic = 1;
  floor.metallicRoughnessTexture.texture = 0;
  floor.metallicRoughnessTexture.wrapU = Wrap::clamp;
  Material wall = plain(vec3(0));
  wall.specular = 0;
  wall.emissive = {4, 3, 2};
  scene.materials = {floor, wall};
  addQuad(scene, {0, 0, 0}, {2, 0, 0}, {0, 0, -1}, 0);
  addQuad(scene, {0, 0.45f, -0.9f}, {2, 0, 0}, {0, 0.35f, 0}, 1);
  scene.sky = evenSky(vec3(0.3f));
  return scene;
}
const Camera kBefore = lookAt({0, 1.1f, 2.2f}, {0, 0.1f, -0.3f});

// Red of the floor's columns, mean over its rows.
std::vector<double> columns(const Frame& frame) {
  std::vector<double> means;
  for (int x = 0; x < kWidth; ++x) {
    double sum = 0, rows = 0;
    for (int y = 0; y < kHeight; ++y) {
      if (frame.at(x, y, "normal.Y") < 0.9f) continue;
      sum += static_cast<double>(frame.at(x, y, "R"));
      ++rows;
    }
    means.push_back(rows > 0 ? sum / rows : 0);
  }
  return means;
}

// Root of the mean square of red on the floor.
double rmse(const Frame& a, const Frame& b) {
  double sum = 0, pixels = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      if (a.at(x, y, "normal.Y") < 0.9f) continue;
      const double off = static_cast<double>(a.at(x, y, "R") - b.at(x, y, "R"));
      sum += off * off;
      ++pixels;
    }
  return std::sqrt(sum / pixels);
}

// The largest step between neighboring columns around the one where roughness is 0.4, of their difference to `other`.
double seam(const Frame& frame, const Frame& other) {
  const std::vector<double> own = columns(frame), others = columns(other);
  double largest = 0;
  for (std::size_t x = kWidth / 4; x < kWidth / 2; ++x)
    largest = std::max(largest, std::abs((own[x + 1] - others[x + 1]) - (own[x] - others[x])));
  return largest;
}

TEST_F(GlossyScreenTest, TheThresholdIsAChoiceOfCostAndNotOfLook) {
  const Scene scene = roughnessRamp();
  const Frame all = draw(scene, kBefore, settings(1), kWidth, kHeight);
  const Frame some = draw(scene, kBefore, settings(0.4f), kWidth, kHeight);
  Frame sky, truth;
  withShaders({kSkyAlone}, [&] { sky = draw(scene, kBefore, settings(0.4f), kWidth, kHeight); });
  withShaders({kAllTraced}, [&] { truth = draw(scene, kBefore, settings(1), kWidth, kHeight); });

  EXPECT_LT(some.report.selected, all.report.selected / 2);
  EXPECT_GT(some.report.rays[kByScreen], 16u * (all.report.selected - some.report.selected));
  const double with = rmse(some, all), without = rmse(sky, all), seamWith = seam(some, all),
               seamWithout = seam(sky, all);
  EXPECT_GT(without, 0.5);
  EXPECT_LT(with, 0.04 * without);
  EXPECT_LT(rmse(some, truth), 0.08 * rmse(sky, truth));
  EXPECT_LT(seamWith, 0.02);
  for (const auto& [name, value] : {std::pair{"rmse_with", with},
                                    {"rmse_without", without},
                                    {"rmse_with_to_all_traced", rmse(some, truth)},
                                    {"rmse_without_to_all_traced", rmse(sky, truth)},
                                    {"seam_with", seamWith},
                                    {"seam_without", seamWithout}})
    RecordProperty(name, std::to_string(value));
}

// A rough metal floor in a closed room whose walls shine evenly. What it reflects of them comes from the screen, and
// what the screen does not show from bounced light: not from both.
TEST_F(GlossyScreenTest, ARoughFloorInAnEvenRoomIsNotBrighterThanWithAllRaysTraced) {
  Scene scene;
  Material floor = plain(vec3(0.8f)), wall = plain(vec3(0));
  floor.metallic = 1;
  floor.roughness = 0.7f;
  wall.specular = 0;
  wall.emissive = vec3(1);
  scene.materials = {floor, wall};
  addBox(scene, vec3(-2), vec3(2), 1, true);
  addQuad(scene, {0, -1.9f, 0}, {2, 0, 0}, {0, 0, -2}, 0);
  scene.sky = evenSky(vec3(1));
  scene.lights = {sun({0, -1, 0}, 200)};  // nothing of it comes in, but it says how bright things are
  const auto floorOf = [&](float maxRoughness) {
    Settings wanted = settings(maxRoughness);
    wanted.shadow.skyDirections = 16;
    wanted.shadow.resolution = 256;
    const Frame frame = draw(scene, lookAt({0, 0.5f, 1.8f}, {0, -1.2f, -1}), wanted, kWidth, kHeight);
    double sum = 0, pixels = 0;
    for (int y = 6 * kHeight / 10; y < 9 * kHeight / 10; ++y)  // away from the walls, where the sun might leak in
      for (int x = 3 * kWidth / 10; x < 7 * kWidth / 10; ++x) {
        EXPECT_GT(frame.at(x, y, "normal.Y"), 0.9f);
        sum += static_cast<double>(frame.at(x, y, "G"));
        ++pixels;
      }
    EXPECT_GT(pixels, 1000);
    return sum / pixels;
  };
  double truth = 0, twice = 0;
  withShaders({kAllTraced}, [&] { truth = floorOf(1); });
  withShaders({kBoth}, [&] { twice = floorOf(0.4f); });
  const double found = floorOf(0.4f);
  RecordProperty("found", std::to_string(found));
  RecordProperty("truth", std::to_string(truth));
  RecordProperty("with_both", std::to_string(twice));
  EXPECT_GT(truth, 0.5);
  EXPECT_LT(found, 1.02 * truth);
  EXPECT_GT(found, 0.5 * truth);
  EXPECT_GT(twice, 1.3 * truth) << "or there is nothing to be counted twice";
}

// What the camera does not see is left to the sky, of which no more is seen than there is.
TEST_F(GlossyScreenTest, WhatTheScreenDoesNotShowIsTheSky) {
  Scene scene = roughnessRamp();
  scene.triangles.resize(2);
  const Frame open = draw(scene, kBefore, settings(0.4f), kWidth, kHeight);
  Frame truth;
  withShaders({kAllTraced}, [&] { truth = draw(scene, kBefore, settings(1), kWidth, kHeight); });
  const std::vector<double> own = columns(open), expected = columns(truth);
  for (std::size_t x = 20; x < kWidth - 20; ++x) EXPECT_NEAR(own[x], expected[x], 0.04 * expected[x]) << x;
}

// A frame that is not glossy between two that are makes nothing anew, and where nobody looks there is no memory for it.
TEST_F(GlossyScreenTest, WhatLooksAtTheScreenIsMadeOnceAndOnlyIfItLooks) {
  const Scene scene = roughnessRamp();
  Renderer renderer = makeRenderer(scene);
  Settings mirrors = settings(0.4f);
  mirrors.effect.glossy = false;
  const auto programs = [&] { return renderer.device().programsCompiled + renderer.device().programsCached; };
  const Frame plain = drawWith(renderer, kBefore, mirrors, kWidth, kHeight);
  const Frame first = drawWith(renderer, kBefore, settings(0.4f), kWidth, kHeight);
  const auto made = programs();
  drawWith(renderer, kBefore, mirrors, kWidth, kHeight);
  const Frame second = drawWith(renderer, kBefore, settings(0.4f), kWidth, kHeight);
  EXPECT_EQ(programs(), made);
  EXPECT_EQ(second.layers.data, first.layers.data);

  const std::size_t seen = std::size_t{16 + 2} * kWidth * kHeight;  // with the occlusion
  EXPECT_EQ(first.report.memory.gbuffer, plain.report.memory.gbuffer + seen);
  Settings idle = settings(0.4f);
  idle.select.mode = SelectMode::none;
  EXPECT_EQ(drawWith(renderer, kBefore, idle, kWidth, kHeight).report.memory.gbuffer, plain.report.memory.gbuffer);
  idle = settings(0.4f);
  idle.trace.method = "none";
  EXPECT_EQ(drawWith(renderer, kBefore, idle, kWidth, kHeight).report.memory.gbuffer, plain.report.memory.gbuffer);
}

TEST_F(GlossyScreenTest, PicturesRepeatToTheBitAndBudgetsLeaveOutWhatAddsLittle) {
  const Scene scene = roughnessRamp();
  const Frame one = draw(scene, kBefore, settings(0.4f), kWidth, kHeight);
  const Frame again = draw(scene, kBefore, settings(0.4f), kWidth, kHeight);
  EXPECT_EQ(one.layers.data, again.layers.data);
  Settings choosy = settings(0.4f);
  choosy.select.minContribution = 0.9f;
  EXPECT_LT(draw(scene, kBefore, choosy, kWidth, kHeight).report.rays[kByScreen], one.report.rays[kByScreen] / 2);
  Settings mirrors = settings(0.4f);
  mirrors.effect.glossy = false;
  EXPECT_EQ(draw(scene, kBefore, mirrors, kWidth, kHeight).report.rays[kByScreen], 0u);
}

}  // namespace
}  // namespace halfsilver::testing
