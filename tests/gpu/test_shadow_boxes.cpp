// Maps of a directional light around the eye, for what is small on large grounds.
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "gpu/light_fixture.h"
#include "passes/light_list.h"

namespace halfsilver::testing {
namespace {

using glm::vec3;
constexpr float kPi = glm::pi<float>();

using ShadowBoxTest = LightTest;

// A ground of many quads, 5 km wide, with two crates 2 km from each other and a tower.
TEST_F(ShadowBoxTest, SunShadowsOfSmallThingsAreThereOnGroundsOfAnyKindWhereverTheEyeIs) {
  constexpr int kSide = 12;
  constexpr float kHalf = 2500, kQuad = kHalf / kSide;
  const float lit = std::sqrt(0.5f);
  for (const bool tower : {false, true}) {
    SCOPED_TRACE(tower);
    Scene scene;
    const std::uint32_t white = addMaterial(scene, diffuse(vec3(1)));
    scene.sky = blackSky();
    scene.lights = {sun({1, -1, 0}, kPi)};
    for (int z = 0; z < kSide; ++z)
      for (int x = 0; x < kSide; ++x)
        addQuad(scene,
                {kQuad * static_cast<float>(2 * x + 1 - kSide), 0, kQuad * static_cast<float>(2 * z + 1 - kSide)},
                {kQuad, 0, 0}, {0, 0, -kQuad}, white);
    const vec3 places[] = {{10, 0, 0}, {1700, 0, 1200}};
    for (const vec3& at : places) addBox(scene, at - vec3(0.5f, 0, 0.5f), at + vec3(0.5f, 1, 0.5f), white);
    if (tower) addBox(scene, {-400, 0, -10}, {-380, 300, 10}, white);
    for (const vec3& at : places) {
      SCOPED_TRACE(at.x);
      const vec3 eye = at + vec3(3, 2, 1);
      for (const float x : {0.6f, 1.0f, 1.4f}) EXPECT_EQ(shadeAt(scene, eye, at + vec3(x, 0, 0)).x, 0) << x;
      for (const vec3& beside : {vec3(1.65f, 0, 0), vec3(1, 0, 0.65f), vec3(0.1f, 0, 1.5f), vec3(8, 0, 1)})
        EXPECT_NEAR(shadeAt(scene, eye, at + beside).x, lit, 5e-3f) << beside.x;
    }
    EXPECT_NEAR(shadeAt(scene, {-40, 5, 3}, {-50, 0, 0}).x, lit, 5e-3f);
    if (tower) {
      EXPECT_EQ(shadeAt(scene, {-100, 5, 3}, {-100, 0, 0}).x, 0);
    }
    EXPECT_LE(shadows.maps.shape().depth, 6);
  }
}

TEST_F(ShadowBoxTest, MapsAroundTheEyeStayUntilItHasGoneFar) {
  Scene scene;
  const std::uint32_t white = addMaterial(scene, diffuse(vec3(1)));
  addQuad(scene, vec3(0), {2500, 0, 0}, {0, 0, -2500}, white);
  for (const float x : {-1000.0f, 1000.0f}) addBox(scene, {x, 0, 0}, {x + 1, 1, 1}, white);
  const GpuScene uploaded = uploadScene(api, scene);
  const auto at = [&](const vec3& eye) {
    return shadowBoxes(uploaded.clusters.all(), uploaded.extents.bounds(), 864, eye);
  };
  const ShadowBoxes first = at({1000, 2, 3});
  ASSERT_GE(first.around.size(), 2u);
  int changes = 0;
  for (float x = 1000; x < 1050; x += 0.5f) changes += at({x, 2, 3}) != at({x + 0.5f, 2, 3});
  EXPECT_GE(changes, 5);
  EXPECT_LE(changes, 25);
  EXPECT_NE(at({1100, 2, 3}), first);
  EXPECT_EQ(at({1100, 2, 3}).around.size(), first.around.size());
  // Each box holds the eye and lies within the next.
  for (std::size_t i = 0; i < first.around.size(); ++i) {
    const Bounds& box = first.around[i];
    EXPECT_LE(box.low.x, 1000);
    EXPECT_GE(box.high.x, 1000);
    if (i == 0) continue;
    EXPECT_LE(box.low.x, first.around[i - 1].low.x);
    EXPECT_GE(box.high.x, first.around[i - 1].high.x);
  }
  // A room has no need of them.
  Scene room;
  addQuad(room, vec3(0), {10, 0, 0}, {0, 0, -10}, addMaterial(room, diffuse(vec3(1))));
  addBox(room, {-1, 0, -1}, {1, 2, 1}, 0);
  EXPECT_TRUE(shadowBoxes(uploadScene(api, room).clusters.all(), {vec3(-10), vec3(10)}, 864, vec3(0)).around.empty());
}

TEST_F(ShadowBoxTest, MapsAroundTheEyeTakeNoLightsShadow) {
  Scene scene;
  const std::uint32_t white = addMaterial(scene, diffuse(vec3(1)));
  addQuad(scene, vec3(0), {25000, 0, 0}, {0, 0, -25000}, white);
  for (const float x : {-10000.0f, 10000.0f}) addBox(scene, {x, 0, 0}, {x + 1, 1, 1}, white);
  const GpuScene uploaded = uploadScene(api, scene);
  const Bounds& whole = uploaded.extents.bounds();
  const ShadowBoxes boxes = shadowBoxes(uploaded.clusters.all(), whole, 8192, {10000, 2, 3});
  ASSERT_GE(boxes.around.size(), 2u);
  scene.lights = {sun({1, -1, 0}, kPi), sun({1, -1, 0.5f}, kPi), bulb({0, 5, 0}, 1)};
  LightListLimits limits;
  limits.skyDirections = 0;
  limits.layers = 9;
  const LightList list = makeLightList(whole, scene.lights, blackSky(), limits, boxes);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_GE(list.lights[i].shadowLayer, 0.0f) << i;
  EXPECT_LE(list.layers, 9);
  ASSERT_EQ(list.warnings.size(), 1u);
  EXPECT_NE(list.warnings[0].find("of a directional light"), std::string::npos);
  limits.layers = 64;
  EXPECT_TRUE(makeLightList(whole, scene.lights, blackSky(), limits, boxes).warnings.empty());
}

}  // namespace
}  // namespace halfsilver::testing
