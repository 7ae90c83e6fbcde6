#include <algorithm>
#include <glm/gtc/constants.hpp>
#include <memory>

#include "gpu/light_fixture.h"

namespace halfsilver::testing {
namespace {

using glm::vec3;
constexpr float kPi = glm::pi<float>();

// A floor of 20 x 20 meters with a box of 2 x 2 x 2 in its middle, lit so that a lit point of the floor has radiance 1.
struct Lit {
  Scene scene;
  std::uint32_t white = 0;
};

Lit floorAndBox() {
  Lit lit;
  lit.white = addMaterial(lit.scene, diffuse(vec3(1)));
  addQuad(lit.scene, vec3(0), {10, 0, 0}, {0, 0, -10}, lit.white);
  addBox(lit.scene, {-1, 0, -1}, {1, 2, 1}, lit.white);
  lit.scene.sky = blackSky();
  return lit;
}

Light spot(const vec3& position, const vec3& target, float candela) {
  Light light = bulb(position, candela);
  light.type = LightType::spot;
  light.direction = glm::normalize(target - position);
  light.outerConeAngle = glm::radians(70.0f);
  return light;
}

using ShadowTest = LightTest;

// The box is 2 meters high and light falls at 45 degrees: its shadow ends 2 meters behind it.
TEST_F(ShadowTest, SunShadowLiesWhereGeometrySays) {
  Scene scene = floorAndBox().scene;
  scene.lights = {sun({1, -1, 0}, kPi)};
  const float lit = std::sqrt(0.5f);
  EXPECT_NEAR(shadeAt(scene, {-6, 6, 3}, {-2, 0, 0}).x, lit, 1e-3f);
  for (const float x : {1.05f, 1.5f, 2.0f, 2.9f}) {
    SCOPED_TRACE(x);
    EXPECT_EQ(shadeAt(scene, {6, 6, 3}, {x, 0, 0}).x, 0);
    EXPECT_NEAR(shadeAt(scene, {6, 6, 3}, {x, 0, 1.1f}).x, lit, 1e-3f);
  }
  for (const float x : {3.1f, 4.0f, 9.5f}) {
    SCOPED_TRACE(x);
    EXPECT_NEAR(shadeAt(scene, {6, 6, 3}, {x, 0, 0}).x, lit, 1e-3f);
  }
  EXPECT_NEAR(shadeAt(scene, {0, 6, 3}, {0, 2, 0}).x, lit, 1e-3f);  // the box's top
}

TEST_F(ShadowTest, SpotAndPointShadowsLieWhereGeometrySays) {
  // From 4 meters above the floor over x = -3, the box's far upper edge at x = 1 throws its shadow to x = 5.
  const vec3 from(-3, 4, 0);
  for (const bool cone : {false, true}) {
    SCOPED_TRACE(cone ? "spot" : "point");
    Scene scene = floorAndBox().scene;
    scene.lights = {cone ? spot(from, {1, 0, 0}, 100) : bulb(from, 100)};
    EXPECT_GT(shadeAt(scene, {-6, 6, 3}, {-2, 0, 0}).x, 0.5f);
    EXPECT_GT(shadeAt(scene, {8, 6, 3}, {5.4f, 0, 0}).x, 0.05f);
    for (const float x : {1.1f, 3.0f, 4.5f}) {
      SCOPED_TRACE(x);
      EXPECT_EQ(shadeAt(scene, {8, 6, 3}, {x, 0, 0}).x, 0);
    }
  }
}

// A lamp inside a room lights all six sides: every layer of its cube is turned right and nothing shadows itself.
TEST_F(ShadowTest, LampLightsAllSidesOfARoom) {
  Scene scene;
  addBox(scene, vec3(-2), vec3(2), addMaterial(scene, diffuse(vec3(1))), true);
  // A small plate before each side, each with its own offset, to be seen as a shadow behind it.
  const std::uint32_t plate = 0;
  scene.sky = blackSky();
  scene.lights = {bulb(vec3(0), kPi)};
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      vec3 n(0), u(0), v(0);
      n[axis] = side;
      u[(axis + 1) % 3] = 1;
      v[(axis + 2) % 3] = 1;
      Scene shadowed = scene;
      addQuad(shadowed, n + 0.5f * u, 0.1f * u, 0.1f * v, plate);
      SCOPED_TRACE(::testing::Message() << "axis " << axis << " side " << side);
      const vec3 eye = -1.5f * n - 1.5f * u + 0.3f * v;
      const auto expected = [&](const vec3& p) { return 2 / std::pow(glm::length(p), 3.0f); };
      for (const vec3& offset : {0.0f * u, -1.0f * u, 1.7f * u + 1.7f * v, 1.0f * v}) {
        const vec3 p = 2.0f * n + offset;
        EXPECT_NEAR(shadeAt(shadowed, eye, p).x, expected(p), 5e-3f * expected(p));
      }
      EXPECT_EQ(shadeAt(shadowed, vec3(-1.5f * n - 1.5f * u), 2.0f * n + 1.0f * u).x, 0);
    }
}

// Left half transparent, right half opaque.
TEST_F(ShadowTest, AlphaCutsHolesIntoShadows) {
  Lit lit;
  Scene& scene = lit.scene;
  lit.white = addMaterial(scene, diffuse(vec3(1)));
  auto texture = std::make_shared<Texture>();
  texture->width = 2;
  texture->height = 1;
  texture->texels = {255, 255, 255, 0, 255, 255, 255, 255};
  scene.textures.push_back(texture);
  Material leaf = diffuse(vec3(1));
  leaf.alphaMode = AlphaMode::mask;
  leaf.baseColorTexture.texture = 0;
  leaf.baseColorTexture.wrapU = Wrap::clamp;
  addQuad(scene, vec3(0), {10, 0, 0}, {0, 0, -10}, lit.white);
  addQuad(scene, {0, 1, 0}, {2, 0, 0}, {0, 0, -2}, addMaterial(scene, leaf));
  scene.sky = blackSky();
  scene.lights = {sun({0, -1, 0}, kPi)};
  EXPECT_NEAR(shadeAt(scene, {-1, 0.5f, 0.1f}, {-1, 0, 0}).x, 1, 1e-3f);
  EXPECT_EQ(shadeAt(scene, {1, 0.5f, 0.1f}, {1, 0, 0}).x, 0);
  EXPECT_NEAR(shadeAt(scene, {3, 0.5f, 0.1f}, {3, 0, 0}).x, 1, 1e-3f);
}

// A sheet that the camera sees from one side only still casts its shadow, whichever side the light comes from.
TEST_F(ShadowTest, BothFacesOfASheetCastShadows) {
  for (const float side : {-1.0f, 1.0f}) {
    Scene scene;
    const std::uint32_t white = addMaterial(scene, diffuse(vec3(1)));
    addQuad(scene, vec3(0), {10, 0, 0}, {0, 0, -10}, white);
    addQuad(scene, {0, 1, 0}, {1, 0, 0}, {0, 0, side}, white);
    scene.sky = blackSky();
    scene.lights = {sun({0, -1, 0}, kPi)};
    EXPECT_EQ(shadeAt(scene, {0.5f, 0.5f, 0}, {0.2f, 0, 0.1f}).x, 0);
    EXPECT_NEAR(shadeAt(scene, {3, 2, 0}, {2, 0, 0}).x, 1, 1e-3f);
  }
}

// Neither acne on a bare floor nor light under the edges of what stands on it, at any height of the sun.
TEST_F(ShadowTest, NoAcneAndNoGapAtContact) {
  for (const float elevation : {5.0f, 20.0f, 45.0f, 90.0f}) {
    SCOPED_TRACE(elevation);
    Scene scene = floorAndBox().scene;
    const float angle = glm::radians(elevation);
    scene.lights = {sun({std::cos(angle), -std::sin(angle), 0.2f * std::cos(angle)}, kPi)};
    Camera camera;
    camera.eye = {-5.5f, 12, 0};
    camera.target = {-5.5f, 0, 0};
    camera.up = {0, 0, -1};
    camera.verticalFov = glm::radians(30.0f);
    draw(scene, camera, 64, 64);
    const float expected = -scene.lights[0].direction.y;
    for (const glm::vec4& pixel : pixels(gbuffer.shaded)) ASSERT_NEAR(pixel.x, expected, 2e-3f);
    if (elevation < 80) {
      EXPECT_LT(shadeAt(scene, {6, 3, 0}, {1.03f, 0, 0}).x, 0.3f * expected);
    }
  }
}

TEST_F(ShadowTest, SaysWhatThereIsNoRoomFor) {
  Scene scene = floorAndBox().scene;
  scene.sky = evenSky(vec3(1));
  for (int i = 0; i < 4; ++i) scene.lights.push_back(bulb({i, 5, 0}, 10));
  settings.shadow.resolution = 4096;  // 64 MiB a layer: 16 of them
  Camera camera;
  camera.eye = {8, 8, 8};
  draw(scene, camera, 8, 8);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("2 of 4 lights"), std::string::npos) << warnings[0];
  EXPECT_EQ(shadows.maps.shape().depth, 13);
  // The lights without shadows still shine.
  EXPECT_GT(middle(pixels(gbuffer.shaded)).x, 0.1f);
}

TEST_F(ShadowTest, SceneWithoutTrianglesOrLights) {
  Scene scene;
  scene.materials.emplace_back();
  Camera camera;
  draw(scene, camera, 4, 4);
  const glm::vec4 sky = middle(pixels(gbuffer.shaded));
  EXPECT_NEAR(sky.x, scene.sky.horizon.x, 0.3f);
  settings.shadow.skyDirections = 0;
  draw(scene, camera, 4, 4);
  EXPECT_NEAR(middle(pixels(gbuffer.shaded)).x, sky.x, 1e-6f);
}

}  // namespace
}  // namespace halfsilver::testing
