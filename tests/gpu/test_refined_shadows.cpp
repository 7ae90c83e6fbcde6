// Shadow maps refined by rays where they are in doubt (shadow.method=refined).
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <halfsilver/builtin.h>
#include "gpu/light_fixture.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

using glm::vec3;
using Choices = std::initializer_list<std::pair<const char*, const char*>>;

constexpr int kWidth = 96, kHeight = 72;

Light lampAt(const vec3& position, float candela) {
  Light lamp;
  lamp.type = LightType::point;
  lamp.position = position;
  lamp.intensity = candela;
  return lamp;
}

// How far apart two pictures are at a pixel, relative to the brighter one.
class Difference {
 public:
  Difference(const Frame& a, const Frame& b) {
    for (const char* channel : {"R", "G", "B"}) {
      a_.push_back(a.plane(channel));
      b_.push_back(b.plane(channel));
    }
  }
  double at(std::size_t pixel) const {
    double most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double a = static_cast<double>(a_[c][pixel]), b = static_cast<double>(b_[c][pixel]);
      most = std::max(most, std::abs(a - b) / std::max({std::abs(a), std::abs(b), 1e-6}));
    }
    return most;
  }

 private:
  std::vector<std::vector<float>> a_, b_;
};

// A floor on y = 0 under a sheet, 4 m wide, at a height of 1 m.
Scene sheetOverFloor(float halfDepth) {
  Scene scene;
  scene.sky = blackSky();
  Material white = diffuse(vec3(0.8f));
  white.doubleSided = true;  // rays do not see a back that the camera does not see
  const std::uint32_t material = addMaterial(scene, white);
  addQuad(scene, vec3(0), {9, 0, 0}, {0, 0, -9}, material);
  addQuad(scene, {0, 1, 0}, {2, 0, 0}, {0, 0, -halfDepth}, material);
  return scene;
}

// Counts of pixels.
struct Doubts {
  std::size_t pixels = 0;  // that show a surface
  std::size_t marked = 0, wrongMarked = 0, wrongUnmarked = 0;
  double worstMarked = 0;  // relative
};

class RefinedShadowTest : public TracingTest {
 protected:
  static Settings settings(const char* method, Choices more = {}) {
    Settings result = settingsWith({{"shadow.sky_directions", "2"}, {"trace.method", "exact"}});
    set(result, "shadow.method", method);
    for (const auto& [name, value] : more) set(result, name, value);
    return result;
  }
  Frame see(const Scene& scene, const Camera& camera, const char* method, Choices more = {}) {
    const Frame frame = draw(scene, camera, settings(method, more), kWidth, kHeight);
    EXPECT_EQ(frame.report.overflow, 0u);
    return frame;
  }
  // Of a refined picture, against that of rays everywhere. A pixel counts as marked if all lights that it may see are.
  static Doubts doubts(const Frame& refined, const Frame& rays) {
    const std::vector<float> depth = refined.plane("depth.Z"), marked = refined.plane("shadow.marked");
    const Difference difference(refined, rays);
    Doubts result;
    for (std::size_t i = 0; i < depth.size(); ++i) {
      if (depth[i] <= 0) continue;
      ++result.pixels;
      const bool wrong = difference.at(i) > 1e-3;
      if (marked[i] > 0) {
        ++result.marked;
        result.wrongMarked += wrong;
        result.worstMarked = std::max(result.worstMarked, difference.at(i));
      } else {
        result.wrongUnmarked += wrong;
      }
    }
    return result;
  }
};

// With one light no other shadow can hide that a marked one is wrong: equal to the bit.
TEST_F(RefinedShadowTest, EveryMarkedPixelHasTheShadowOfItsRay) {
  for (const char* name : {"sphere", "teapot", "atrium"}) {
    Scene scene = makeBuiltin(name).scene;
    scene.lights = {sun({-0.4f, -1, -0.3f}, 3)};
    for (const char* resolution : {"64", "512"}) {
      SCOPED_TRACE(std::string(name) + ", maps of " + resolution);
      const Camera camera = scene.cameras.front();
      const Frame refined = see(scene, camera, "refined", {{"shadow.resolution", resolution}});
      const Frame rays = see(scene, camera, "rays", {{"shadow.resolution", resolution}});  // of the sky's maps
      const Frame maps = see(scene, camera, "maps", {{"shadow.resolution", resolution}});
      const Doubts found = doubts(refined, rays);
      EXPECT_GT(found.marked, 200u);
      EXPECT_LT(found.marked, found.pixels);
      EXPECT_EQ(found.worstMarked, 0) << found.marked << " pixels";
      EXPECT_LT(refined.report.rays[RAY_SHADOW], rays.report.rays[RAY_SHADOW]);
      // The maps' own answers there are wrong.
      const Difference ofMaps(maps, rays);
      const std::vector<float> marked = refined.plane("shadow.marked");
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < marked.size(); ++i) wrong += marked[i] > 0 && ofMaps.at(i) > 1e-2;
      EXPECT_GT(wrong, 50u);
    }
  }
}

TEST_F(RefinedShadowTest, AnUnmarkedPixelKeepsTheMapsAnswer) {
  Scene scene = sheetOverFloor(0.7f);
  scene.lights = {sun({-0.3f, -1, -0.4f}, 2), lampAt({1, 2.5f, 1.5f}, 5), lampAt({-1.5f, 1.7f, 0.5f}, 3)};
  const Frame refined = see(scene, kAbove, "refined", {{"shadow.resolution", "256"}});
  const Frame maps = see(scene, kAbove, "maps", {{"shadow.resolution", "256"}});
  const Difference difference(refined, maps);
  const std::vector<float> depth = refined.plane("depth.Z"), marked = refined.plane("shadow.marked"),
                           lit = refined.plane("shadow.lit");
  std::size_t unmarked = 0, shadowed = 0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (depth[i] <= 0 || marked[i] > 0) continue;
    ++unmarked;
    shadowed += lit[i] < 3;
    ASSERT_LT(difference.at(i), 1e-5) << i;
  }
  EXPECT_GT(unmarked, 500u);
  EXPECT_GT(shadowed, 100u);
}

TEST_F(RefinedShadowTest, AWiderKernelMarksMoreAndLeavesFewerWrong) {
  Scene scene = makeBuiltin("teapot").scene;
  scene.lights = {sun({-0.4f, -1, -0.3f}, 3)};
  const Frame rays = see(scene, scene.cameras.front(), "rays");
  Doubts before;
  for (const char* kernel : {"1", "3", "5", "7", "9"}) {
    SCOPED_TRACE(kernel);
    const Frame refined = see(scene, scene.cameras.front(), "refined", {{"shadow.kernel", kernel}});
    const Doubts found = doubts(refined, rays);
    EXPECT_EQ(found.wrongMarked, 0u);
    EXPECT_GT(found.marked, before.marked);
    if (before.pixels > 0) {
      EXPECT_LE(found.wrongUnmarked, before.wrongUnmarked);
    }
    RecordProperty(std::string("wrong_of_") + kernel, std::to_string(found.wrongUnmarked));
    before = found;
  }
  EXPECT_LT(before.marked, before.pixels);
}

// A caster that the map's texels miss leaves no edge, so nothing marks where its shadow belongs (B17 of the paper).
TEST_F(RefinedShadowTest, AShadowThatTheMapMissesAltogetherStaysMissing) {
  Scene scene = sheetOverFloor(0.004f);  // maps of 64 texels have one in 0.28 m
  scene.lights = {sun({0, -1, 0.3f}, 2)};
  const Camera camera = lookAt({0, 0.9f, 1.2f}, {0, 0, 0.3f});
  const Frame rays = draw(scene, camera, settings("rays"), 4 * kWidth, 4 * kHeight);
  const auto wrongWith = [&](const char* resolution) {
    const Frame refined =
        draw(scene, camera, settings("refined", {{"shadow.resolution", resolution}}), 4 * kWidth, 4 * kHeight);
    const Doubts found = doubts(refined, rays);
    EXPECT_EQ(found.wrongMarked, 0u);
    return found.wrongUnmarked;
  };
  const std::vector<float> lit = rays.plane("G");
  EXPECT_GT(std::count(lit.begin(), lit.end(), 0.0f), 200) << "there is a shadow";
  EXPECT_GT(wrongWith("64"), 200u);
  EXPECT_EQ(wrongWith("4096"), 0u);
}

TEST_F(RefinedShadowTest, WhatAMapCannotKnowIsLeftToRaysEverywhere) {
  Scene scene = soup(60);
  Light ball = lampAt({1, 2.5f, 1.5f}, 5);
  ball.type = LightType::sphere;
  ball.radius = 0.4f;
  scene.lights = {ball};
  const Frame refined = see(scene, kAbove, "refined"), rays = see(scene, kAbove, "rays");
  EXPECT_EQ(refined.plane("G"), rays.plane("G"));
  EXPECT_EQ(refined.report.rays[RAY_SHADOW], rays.report.rays[RAY_SHADOW]);
  EXPECT_GT(rays.report.rays[RAY_SHADOW], 10000u);
}

TEST_F(RefinedShadowTest, MoreLightsThanAMaskHasBitsAreAllRefined) {
  Scene scene = soup(80);
  for (Material& material : scene.materials) material = diffuse(vec3(0.6f));
  for (int i = 0; i < 40; ++i)
    scene.lights.push_back(
        sun({0.8f * std::sin(static_cast<float>(i)), -1, 0.8f * std::cos(static_cast<float>(i))}, 0.1f));
  const Frame refined = see(scene, kAbove, "refined", {{"shadow.kernel", "31"}});
  const Frame rays = see(scene, kAbove, "rays");
  const std::vector<float> marked = refined.plane("shadow.marked");
  EXPECT_GT(*std::max_element(marked.begin(), marked.end()), 32);
  const Doubts found = doubts(refined, rays);
  EXPECT_LT(found.wrongUnmarked + found.wrongMarked, found.pixels / 50);
}

TEST_F(RefinedShadowTest, EveryMethodFindsTheSameShadows) {
  Scene scene = soup(120);
  scene.lights = {sun({-0.3f, -1, -0.4f}, 2)};
  const Frame exact = see(scene, kAbove, "refined", {{"trace.bounces", "2"}});
  for (const char* method : {"identity", "bvh"}) {
    SCOPED_TRACE(method);
    const Frame found = see(scene, kAbove, "refined", {{"trace.bounces", "2"}, {"trace.method", method}});
    EXPECT_EQ(found.report.rays[RAY_SHADOW], exact.report.rays[RAY_SHADOW]);
    EXPECT_EQ(found.plane("shadow.marked"), exact.plane("shadow.marked"));
    const Difference difference(found, exact);
    for (std::size_t i = 0; i < found.layers.pixelCount(); ++i) ASSERT_LT(difference.at(i), 1e-3) << i;
  }
}

TEST_F(RefinedShadowTest, WhoCannotHaveThemIsTold) {
  Scene scene = soup(50);
  scene.lights = {sun({-0.3f, -1, -0.4f}, 2)};
  const Frame frame = see(scene, kAbove, "refined", {{"trace.method", "none"}});
  ASSERT_EQ(frame.report.warnings.size(), 1u);
  EXPECT_NE(frame.report.warnings[0].find("shadow maps are used"), std::string::npos);
}

// Rays to lights are sent from the camera's hits there, too: those of certain lights are not needed.
TEST_F(RefinedShadowTest, WhittedSendsRaysToDoubtfulLightsAlone) {
  Scene scene = soup(120);
  scene.lights = {sun({-0.3f, -1, -0.4f}, 2)};
  const Frame rays = see(scene, kAbove, "maps", {{"trace.effect", "whitted"}, {"shadow.resolution", "512"}});
  const Frame refined = see(scene, kAbove, "refined", {{"trace.effect", "whitted"}, {"shadow.resolution", "512"}});
  EXPECT_EQ(refined.report.warnings.size(), 0u);
  EXPECT_LT(refined.report.rays[RAY_SHADOW], 0.8 * static_cast<double>(rays.report.rays[RAY_SHADOW]));
  EXPECT_EQ(refined.report.rays[RAY_REFLECTION], rays.report.rays[RAY_REFLECTION]);
  const Doubts found = doubts(refined, rays);
  EXPECT_GT(found.marked, 500u);
  EXPECT_LT(found.marked, found.pixels);
  EXPECT_EQ(found.worstMarked, 0);
  EXPECT_LT(found.wrongUnmarked, found.pixels / 50);
}

// A structure by demand keeps what the rays of a frame needed: other rules send others.
TEST_F(RefinedShadowTest, OtherRulesAreOtherRaysForWhatIsKept) {
  Scene scene = soup(600);
  scene.lights = {sun({-0.3f, -1, -0.4f}, 2)};
  Renderer renderer = makeRenderer(scene);
  const auto settings = [](std::initializer_list<std::pair<const char*, const char*>> more) {
    Settings wanted = settingsWith({{"trace.method", "identity"}, {"shadow.resolution", "64"}});
    for (const auto& [name, value] : more) set(wanted, name, value);
    return wanted;
  };
  const Settings steps[] = {settings({{"shadow.method", "refined"}, {"shadow.kernel", "1"}, {"primary.every", "8"}}),
                            settings({{"shadow.method", "refined"}, {"shadow.kernel", "1"}}),
                            settings({{"shadow.method", "refined"}, {"shadow.kernel", "9"}}),
                            settings({{"shadow.method", "rays"}})};
  for (const Settings& step : steps) {
    const Frame kept = drawWith(renderer, kAbove, step, 80, 60), fresh = draw(scene, kAbove, step, 80, 60);
    EXPECT_EQ(kept.report.overflow, 0u);
    EXPECT_EQ(kept.plane("G"), fresh.plane("G"));
    EXPECT_GT(kept.report.rays[RAY_SHADOW], 20u);
  }
}

}  // namespace
}  // namespace halfsilver::testing
