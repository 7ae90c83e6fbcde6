#include <cmath>
#include <glm/gtc/constants.hpp>

#include "gpu/light_fixture.h"

namespace halfsilver::testing {
namespace {

using glm::vec3;
constexpr float kPi = glm::pi<float>();

Scene plate(const Material& material) {
  Scene scene;
  addQuad(scene, {0, 0, 0}, {2, 0, 0}, {0, 0, -2}, addMaterial(scene, material));
  scene.sky = blackSky();
  return scene;
}

void expectColor(const glm::vec4& found, const vec3& expected, float tolerance) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(found[c], expected[c], tolerance * std::max(expected[c], 1e-3f)) << "channel " << c;
}

using LightingTest = LightTest;

TEST_F(LightingTest, LambertPlateUnderTheSun) {
  Scene scene = plate(diffuse({0.8f, 0.4f, 0.2f}));
  scene.lights = {sun({1, -1, 0}, 3)};
  const float irradiance = 3 * std::cos(glm::radians(45.0f));
  expectColor(shadeAt(scene, {0, 2, 1}, {0.1f, 0, 0.1f}), vec3(0.8f, 0.4f, 0.2f) * irradiance / kPi, 1e-3f);
}

TEST_F(LightingTest, LightsAdd) {
  Scene scene = plate(diffuse(vec3(0.5f)));
  scene.lights = {sun({0, -1, 0}, 1), sun({1, -1, 0}, 2)};
  const float irradiance = 1 + 2 * std::sqrt(0.5f);
  expectColor(shadeAt(scene, {0, 2, 1}, {0, 0, 0}), vec3(0.5f * irradiance / kPi), 1e-3f);
}

// Shaders keep which lights may reach a surface in words of 32 bits.
TEST_F(LightingTest, ManyLightsAdd) {
  Scene scene = plate(diffuse(vec3(1)));
  settings.shadow.resolution = 16;
  float irradiance = 0;
  for (int i = 0; i < 75; ++i) {
    const float lux = static_cast<float>(i % 7);
    scene.lights.push_back(sun({0, i % 5 == 4 ? 1 : -1, 0}, lux));  // one in five shines from below
    if (i % 5 != 4) irradiance += lux;
  }
  expectColor(shadeAt(scene, {0, 4, 1}, {0, 0, 0}), vec3(irradiance / kPi), 1e-3f);
}

TEST_F(LightingTest, PointLightFallsWithTheSquareOfTheDistance) {
  for (const float height : {0.5f, 1.0f, 3.0f}) {
    Scene scene = plate(diffuse(vec3(1)));
    Light light;
    light.type = LightType::point;
    light.position = {0, height, 0};
    light.intensity = 5;
    scene.lights = {light};
    expectColor(shadeAt(scene, {1, 4, 1}, {0, 0, 0}), vec3(5 / (height * height) / kPi), 2e-3f);
  }
}

TEST_F(LightingTest, RangeEndsALight) {
  Scene scene = plate(diffuse(vec3(1)));
  Light light;
  light.type = LightType::point;
  light.position = {0, 1, 0};
  light.range = 2;
  scene.lights = {light};
  expectColor(shadeAt(scene, {1, 4, 1}, {0, 0, 0}), vec3((1 - 1.0f / 16) / kPi), 2e-3f);
  scene.lights[0].range = 0.9f;
  expectColor(shadeAt(scene, {1, 4, 1}, {0, 0, 0}), vec3(0), 1e-6f);
}

TEST_F(LightingTest, SpotFallsBetweenItsCones) {
  Scene scene = plate(diffuse(vec3(1)));
  Light light;
  light.type = LightType::spot;
  light.position = {0, 1, 0};
  light.direction = {0, -1, 0};
  light.innerConeAngle = glm::radians(20.0f);
  light.outerConeAngle = glm::radians(50.0f);
  scene.lights = {light};
  for (const float degrees : {0.0f, 10.0f, 30.0f, 40.0f, 55.0f}) {
    const float angle = glm::radians(degrees), cosine = std::cos(angle);
    const float inner = std::cos(light.innerConeAngle), outer = std::cos(light.outerConeAngle);
    const float fall = std::clamp((cosine - outer) / (inner - outer), 0.0f, 1.0f);
    // Distance 1 / cos, and another cosine for the plate.
    const float expected = fall * fall * cosine * cosine * cosine / kPi;
    SCOPED_TRACE(degrees);
    expectColor(shadeAt(scene, {0, 4, 2}, {std::tan(angle), 0, 0}), vec3(expected), 5e-3f);
  }
}

// A rectangle over a floor: the deferred pass takes it as a point. At a distance of ten times its size that is right
// within 1 %; the closed form is the form factor of a parallel rectangle over a small patch.
TEST_F(LightingTest, FarRectanglesLightAsTheirFormFactorSays) {
  const float width = 0.2f, height = 0.3f, up = 3;
  const auto corner = [&](float x, float z) {  // of a rectangle whose corner is over the patch
    const float a = x / up, b = z / up, p = std::sqrt(1 + a * a), q = std::sqrt(1 + b * b);
    return (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2 * kPi);
  };
  for (const float x : {0.0f, 1.0f, 1.9f}) {
    Scene scene = plate(diffuse(vec3(1)));
    Light light;
    light.type = LightType::rectangle;
    light.position = {0, up, 0};
    light.direction = {0, -1, 0};
    light.up = {0, 0, 1};
    light.width = width;
    light.height = height;
    light.intensity = 7;
    scene.lights = {light};
    const float low = x - 0.5f * width, high = x + 0.5f * width;
    const float formFactor = 2 * (corner(high, 0.5f * height) - corner(low, 0.5f * height));
    SCOPED_TRACE(x);
    expectColor(shadeAt(scene, {0, 4, 2}, {x, 0, 0}), vec3(7 * formFactor), 1e-2f);
    scene.lights[0].direction = {0, 1, 0};
    expectColor(shadeAt(scene, {0, 4, 2}, {x, 0, 0}), vec3(0), 1e-6f);
  }
}

// Exact wherever all of the sphere is above the horizon.
TEST_F(LightingTest, SpheresLightAsTheirClosedFormSays) {
  for (const float x : {0.0f, 1.0f, 1.9f}) {
    Scene scene = plate(diffuse(vec3(1)));
    Light light;
    light.type = LightType::sphere;
    light.position = {0, 1.5f, 0};
    light.radius = 0.4f;
    light.intensity = 7;
    scene.lights = {light};
    const float distance = std::sqrt(x * x + 2.25f), cosine = 1.5f / distance;
    const float sine2 = 0.16f / (distance * distance);
    SCOPED_TRACE(x);
    expectColor(shadeAt(scene, {0, 4, 2}, {x, 0, 0}), vec3(7 * sine2 * cosine), 5e-3f);
  }
}

TEST_F(LightingTest, AreaLightsCastShadows) {
  for (const LightType type : {LightType::rectangle, LightType::sphere}) {
    Scene scene = plate(diffuse(vec3(1)));
    addQuad(scene, {0, 0.5f, 0}, {0.5f, 0, 0}, {0, 0, -0.5f}, 0);
    Light light;
    light.type = type;
    light.position = {0, 1, 0};
    light.direction = {0, -1, 0};
    light.width = light.height = 0.1f;
    scene.lights = {light};
    expectColor(shadeAt(scene, {0, 0.1f, 3}, {0.5f, 0, 0}), vec3(0), 1e-6f);
    EXPECT_GT(shadeAt(scene, {0, 4, 3}, {1.5f, 0, 0}).x, 1e-4f) << "beside the shadow";
  }
}

TEST_F(LightingTest, MetalFollowsGgx) {
  Material metal;
  metal.baseColor = {0.9f, 0.6f, 0.3f, 1};
  metal.roughness = 0.5f;
  Scene scene = plate(metal);
  scene.lights = {sun({1, -2, 0}, 2)};
  const vec3 eye(1.5f, 2, 0.5f);
  const vec3 n(0, 1, 0), v = glm::normalize(eye), l = -scene.lights[0].direction, h = glm::normalize(v + l);
  const float a2 = std::pow(0.5f, 4.0f), nl = l.y, nv = v.y, nh = glm::dot(n, h);
  const float d = a2 / (kPi * std::pow(nh * nh * (a2 - 1) + 1, 2.0f));
  const float g = 0.5f / (nl * std::sqrt(nv * nv * (1 - a2) + a2) + nv * std::sqrt(nl * nl * (1 - a2) + a2));
  const vec3 f0(metal.baseColor);
  const vec3 f = f0 + (1.0f - f0) * std::pow(1 - glm::dot(v, h), 5.0f);
  expectColor(shadeAt(scene, eye, {0, 0, 0}), f * d * g * nl * 2.0f, 2e-3f);
}

// A mirror material's deferred part is Lambert's alone: the blend takes Fresnel's share away.
TEST_F(LightingTest, MirrorKeepsItsBaseColor) {
  Scene scene = plate(mirror(0.5f, {0.2f, 0.6f, 0.4f}));
  scene.lights = {sun({1, -1, 0}, kPi)};
  expectColor(shadeAt(scene, {-2, 2, 0.7f}, {0, 0, 0}), vec3(0.2f, 0.6f, 0.4f) * std::sqrt(0.5f), 5e-3f);
}

TEST_F(LightingTest, UnlitAndEmissive) {
  Material material = diffuse({0.3f, 0.5f, 0.7f});
  material.unlit = true;
  Scene scene = plate(material);
  scene.lights = {sun({0, -1, 0}, 100)};
  expectColor(shadeAt(scene, {0, 2, 1}, {0, 0, 0}), {0.3f, 0.5f, 0.7f}, 1e-3f);
  material.unlit = false;
  material.emissive = {2, 1, 0.5f};
  scene.materials[0] = material;
  scene.lights.clear();
  expectColor(shadeAt(scene, {0, 2, 1}, {0, 0, 0}), {2, 1, 0.5f}, 1e-3f);
}

// A white surface under an even sky can send back what arrives, and no more.
TEST_F(LightingTest, WhiteFurnace) {
  for (const int directions : {0, 12, 32}) {
    settings.shadow.skyDirections = directions;
    for (const vec3 normal : {vec3(0, 1, 0), vec3(1, 0, 0), vec3(0, -1, 0), vec3(0.6f, 0.8f, 0)}) {
      Scene scene;
      const vec3 u = glm::normalize(glm::cross(normal, vec3(0, 0, 1)));
      addQuad(scene, vec3(0), u, glm::cross(normal, u), addMaterial(scene, diffuse(vec3(1))));
      scene.sky = evenSky(vec3(1));
      SCOPED_TRACE(directions);
      const float radiance = shadeAt(scene, 3.0f * normal + 0.1f * u, vec3(0)).x;
      EXPECT_GT(radiance, 0.65f);
      EXPECT_LT(radiance, 1.05f);
      if (normal.y == 1) {
        EXPECT_NEAR(radiance, 1, 0.01f);
      }
    }
  }
}

TEST_F(LightingTest, SkyVisibilityOfAFreePlane) {
  const Scene base = plate(diffuse(vec3(1)));
  Scene scene = base;
  scene.sky = Sky();
  EXPECT_NEAR(shadeAt(scene, {0, 2, 1}, {0.3f, 0, 0.2f}).w, 1, 1e-3f);
}

TEST_F(LightingTest, SkyVisibilityNextToAWall) {
  Scene scene;
  const std::uint32_t white = addMaterial(scene, diffuse(vec3(1)));
  addQuad(scene, {0, 0, 0}, {10, 0, 0}, {0, 0, -10}, white);
  addQuad(scene, {0, 20, 0}, {0, 20, 0}, {0, 0, 10}, white);  // faces +x
  scene.sky = evenSky(vec3(1));
  settings.shadow.skyDirections = 32;
  settings.shadow.resolution = 2048;
  EXPECT_NEAR(shadeAt(scene, {3, 2, 0}, {0.4f, 0, 0}).w, 0.5f, 0.1f);
  EXPECT_GT(shadeAt(scene, {9, 2, 0}, {9, 0, 0}).w, 0.7f);
}

TEST_F(LightingTest, SkyVisibilityInAClosedBox) {
  Scene scene;
  addBox(scene, vec3(-1), vec3(1), addMaterial(scene, diffuse(vec3(1))), true);
  scene.sky = evenSky(vec3(1));
  EXPECT_LT(shadeAt(scene, {0, 0.5f, 0.3f}, {0, -1, 0}).w, 0.02f);
  EXPECT_LT(shadeAt(scene, {0, 0, 0}, {1, 0.2f, 0.1f}).w, 0.02f);
  // Not quite black: the bounced light.
  const float radiance = shadeAt(scene, {0, 0, 0}, {1, 0.2f, 0.1f}).x;
  EXPECT_GT(radiance, 0.02f);
  EXPECT_LT(radiance, 0.3f);
}

TEST_F(LightingTest, PixelsWithoutSurfaceShowTheGradient) {
  Scene scene = plate(diffuse(vec3(1)));
  scene.sky.zenith = {0, 0, 2};
  scene.sky.horizon = {0, 1, 0};
  scene.sky.ground = {3, 0, 0};
  Camera camera;
  camera.eye = {0, 5, 0};
  camera.target = {0, 6, 0};
  camera.up = {0, 0, -1};
  camera.verticalFov = 0.1f;
  draw(scene, camera, 5, 5);
  expectColor(middle(pixels(gbuffer.shaded)), {0, 0, 2}, 0.01f);
  camera.target = {-1, 5, 0};
  camera.up = {0, 1, 0};
  draw(scene, camera, 5, 5);
  expectColor(middle(pixels(gbuffer.shaded)), {0, 1, 0}, 0.02f);
  camera.eye = {100, 5, 0};
  camera.target = {101, 3, 0};
  draw(scene, camera, 5, 5);
  expectColor(middle(pixels(gbuffer.shaded)), {3, 0, 0}, 0.02f);
}

TEST_F(LightingTest, EquirectangularSkyIsTurnedRight) {
  Scene scene = plate(diffuse(vec3(1)));
  // u = 0.5 + atan2(x, -z) / 2 pi: -z in the middle, +x at three quarters; rows from the top.
  scene.sky.imageWidth = 8;
  scene.sky.imageHeight = 4;
  scene.sky.image.assign(8 * 4 * 3, 0.0f);
  const auto paint = [&](int x, int y, const vec3& color) {
    for (int c = 0; c < 3; ++c) scene.sky.image[static_cast<std::size_t>(3 * (y * 8 + x) + c)] = color[c];
  };
  for (const int y : {1, 2}) {
    for (const int x : {5, 6}) paint(x, y, {1, 0, 0});  // +x
    for (const int x : {3, 4}) paint(x, y, {0, 1, 0});  // -z
    for (const int x : {1, 2}) paint(x, y, {0, 0, 1});  // -x
  }
  for (int x = 0; x < 8; ++x) paint(x, 0, {2, 2, 2});  // up
  scene.sky.intensity = 0.5f;
  Camera camera;
  camera.eye = {0, 5, 0};
  camera.verticalFov = 0.1f;
  const auto look = [&](const vec3& direction) {
    camera.target = camera.eye + direction;
    draw(scene, camera, 5, 5);
    return middle(pixels(gbuffer.shaded));
  };
  expectColor(look({1, 0, 0}), {0.5f, 0, 0}, 0.02f);
  expectColor(look({0, 0, -1}), {0, 0.5f, 0}, 0.02f);
  expectColor(look({-1, 0, 0}), {0, 0, 0.5f}, 0.02f);
  expectColor(look({0, 0, 1}), {0, 0, 0}, 0.02f);
  expectColor(look({0, 1, 1e-3f}), {1, 1, 1}, 0.05f);
}

}  // namespace
}  // namespace halfsilver::testing
