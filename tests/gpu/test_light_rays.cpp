// Shadows by rays (shadow.method=rays) in the deferred shading and in what mirrors show.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <memory>
#include <string>
#include <vector>

#include <halfsilver/builtin.h>
#include "effects/light_rays/light_rays.h"
#include "gpu/light_fixture.h"
#include "gpu/ray_witness.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

using glm::vec3;

constexpr int kWidth = 64, kHeight = 48;

class LightRaysTest : public WitnessTest {
 protected:
  static Settings settings(std::initializer_list<std::pair<const char*, const char*>> more = {}) {
    Settings result = settingsWith({{"shadow.method", "rays"}, {"shadow.sky_directions", "2"}});
    for (const auto& [name, value] : more) set(result, name, value);
    return result;
  }
  Frame see(const Scene& scene, const Camera& camera,
            std::initializer_list<std::pair<const char*, const char*>> more = {}) {
    const Frame frame = draw(scene, camera, settings(more), kWidth, kHeight);
    EXPECT_EQ(frame.report.overflow, 0u);
    return frame;
  }
};

Light lampAt(const vec3& position, float candela) {
  Light lamp;
  lamp.type = LightType::point;
  lamp.position = position;
  lamp.intensity = candela;
  return lamp;
}

// A floor on y = 0 under a sheet of 2 m by 2 m at a height of 1.
Scene sheetOverFloor(Material sheet) {
  Scene scene;
  sheet.doubleSided = true;  // rays do not see a back that the camera does not see
  scene.sky = blackSky();
  addQuad(scene, vec3(0), {9, 0, 0}, {0, 0, -9}, addMaterial(scene, diffuse(vec3(1))));
  addQuad(scene, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}, addMaterial(scene, sheet));
  return scene;
}

// From below the sheet's height, so that it hides nothing.
const Camera kUnderSheet = lookAt({0, 0.95f, 2.6f}, {0, 0, 0.9f});

struct Place {
  int x, y;
  vec3 position;
};

// Where the floor is seen.
std::vector<Place> floorPlaces(const Camera& camera) {
  std::vector<Place> places;
  const vec3 forward = glm::normalize(camera.target - camera.eye);
  const vec3 right = glm::normalize(glm::cross(forward, vec3(0, 1, 0))), up = glm::cross(right, forward);
  const float tangent = std::tan(0.5f * camera.verticalFov);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const float sx = static_cast<float>(2 * x + 1 - kWidth) / kHeight * tangent;
      const float sy = static_cast<float>(kHeight - 2 * y - 1) / kHeight * tangent;
      const vec3 ray = forward + sx * right + sy * up;
      if (ray.y > -0.05f) continue;
      places.push_back({x, y, camera.eye - ray * (camera.eye.y / ray.y)});
    }
  return places;
}

TEST_F(LightRaysTest, AShadowsEdgeIsWhereGeometryHasIt) {
  Scene scene = sheetOverFloor(diffuse(vec3(0.5f)));
  scene.lights = {sun({-0.5f, -1, 0.25f}, 2)};
  const Frame frame = see(scene, kUnderSheet);
  int lit = 0, dark = 0;
  for (const Place& place : floorPlaces(kUnderSheet)) {
    // Where the ray to the sun passes the sheet's height.
    const vec3 above = place.position + vec3(0.5f, 1, -0.25f);
    if (std::abs(place.position.x) > 8 || std::abs(place.position.z) > 8) continue;
    const bool hidden = std::max(std::abs(above.x), std::abs(above.z)) < 1;
    const float value = frame.at(place.x, place.y, "G");
    ++(hidden ? dark : lit);
    if (hidden)
      ASSERT_EQ(value, 0) << place.x << " " << place.y;
    else
      ASSERT_GT(value, 0.2f) << place.x << " " << place.y;
  }
  EXPECT_GT(lit, 500);
  EXPECT_GT(dark, 100);
}

TEST_F(LightRaysTest, ARectanglesShadowIsAsDeepAsTheShareOfItThatIsHidden) {
  Scene scene = sheetOverFloor(diffuse(vec3(0.5f)));
  Light panel;
  panel.type = LightType::rectangle;
  panel.position = {0, 2, 0};
  panel.direction = {0, -1, 0};
  panel.up = {0, 0, -1};
  panel.width = panel.height = 1;
  panel.intensity = 3;
  scene.lights = {panel};
  const auto light = [&](const char* samples, bool sheet) {
    Scene seen = scene;
    if (!sheet) seen.triangles.resize(2);
    return see(seen, kUnderSheet, {{"shadow.samples", samples}});
  };
  const Frame with = light("64", true), without = light("64", false), rough = light("1", true);
  double worst = 0, single = 0;
  int soft = 0;
  for (const Place& place : floorPlaces(kUnderSheet)) {
    if (std::abs(place.position.x) > 4 || std::abs(place.position.z) > 4) continue;
    // The panel's place seen through the sheet's plane, half way up: a square of half its size that the sheet covers.
    const auto shown = [](float x) {
      const float low = 0.5f * x - 0.25f, high = 0.5f * x + 0.25f;
      return (std::min(high, 1.0f) - std::max(low, -1.0f)) / 0.5f;
    };
    const float hidden =
        std::clamp(shown(place.position.x), 0.0f, 1.0f) * std::clamp(shown(place.position.z), 0.0f, 1.0f);
    const float full = without.at(place.x, place.y, "G"), found = with.at(place.x, place.y, "G");
    if (full < 0.05f) continue;
    soft += hidden > 0.1f && hidden < 0.9f;
    // The hidden part is not as bright as the rest, seen at another slant: within 15 % here.
    const double error = std::abs(static_cast<double>(found / full - (1 - hidden)));
    worst = std::max(worst, error);
    single = std::max(single, std::abs(static_cast<double>(rough.at(place.x, place.y, "G") / full - (1 - hidden))));
  }
  EXPECT_GT(soft, 100);
  EXPECT_LT(worst, 0.15);
  EXPECT_GT(single, 2 * worst) << "one ray per pixel";
  RecordProperty("worst", std::to_string(worst));
}

TEST_F(LightRaysTest, HolesInAMaterialLetLightThrough) {
  Material holed = diffuse(vec3(0.5f));
  holed.alphaMode = AlphaMode::mask;
  holed.alphaCutoff = 0.5f;
  holed.baseColorTexture.texture = 0;
  holed.baseColorTexture.magnify = holed.baseColorTexture.minify = Filter::nearest;
  holed.baseColorTexture.mipmaps = false;
  Scene scene = sheetOverFloor(holed);
  scene.lights = {sun({0, -1, 0}, 2)};
  // Opaque for x < 0 alone.
  const Texture texture{.name = "half", .width = 2, .height = 1, .texels = {255, 255, 255, 255, 255, 255, 255, 0}};
  scene.textures = {std::make_shared<Texture>(texture)};
  const Frame frame = see(scene, kUnderSheet);
  int lit = 0, dark = 0;
  for (const Place& place : floorPlaces(kUnderSheet)) {
    if (std::abs(place.position.z) > 0.95f || std::abs(place.position.x) > 0.95f || std::abs(place.position.x) < 0.02f)
      continue;
    const bool hidden = place.position.x < 0;
    ++(hidden ? dark : lit);
    ASSERT_EQ(frame.at(place.x, place.y, "G") > 0, !hidden) << place.x << " " << place.y;
  }
  EXPECT_GT(lit, 100);
  EXPECT_GT(dark, 100);
}

TEST_F(LightRaysTest, AColoredPaneColorsTheLight) {
  Material pane = plain({0.9f, 0.5f, 0.2f});
  pane.roughness = 0;
  pane.transmission = 1;
  Scene scene = sheetOverFloor(pane);
  scene.lights = {sun({0, -1, 0}, 2)};
  const Frame frame = see(scene, kUnderSheet);
  const float irradiance = 2 / glm::pi<float>();
  int seen = 0;
  for (const Place& place : floorPlaces(kUnderSheet)) {
    if (std::abs(place.position.z) > 0.95f || std::abs(place.position.x) > 0.95f) continue;
    ++seen;
    const vec3 color{frame.at(place.x, place.y, "R"), frame.at(place.x, place.y, "G"), frame.at(place.x, place.y, "B")};
    // Fresnel's 4 % are reflected.
    for (int i = 0; i < 3; ++i) ASSERT_NEAR(color[i], 0.96f * irradiance * pane.baseColor[i], 2e-3f) << i;
  }
  EXPECT_GT(seen, 100);
}

// The same shading with rays instead of maps: all that a mirror floor shows, and itself.
TEST_F(LightRaysTest, ThePictureIsWhittedsIfNothingIsClear) {
  Scene scene = soup(120);
  scene.lights = {sun({-0.3f, -1, -0.4f}, 2), lampAt({1, 2.5f, 1.5f}, 5), lampAt({-1.5f, 0.7f, 0.5f}, 3)};
  for (const char* bounces : {"1", "3"}) {
    SCOPED_TRACE(bounces);
    const Frame found = see(scene, kAbove, {{"trace.bounces", bounces}});
    const Frame expected = see(scene, kAbove, {{"trace.bounces", bounces}, {"trace.effect", "whitted"}});
    EXPECT_GT(found.report.rays[RAY_SHADOW], 4000u);
    double worst = 0, brightest = 0;
    for (const char* channel : {"R", "G", "B"}) {
      const std::vector<float> a = found.plane(channel), b = expected.plane(channel);
      for (std::size_t i = 0; i < a.size(); ++i) {
        brightest = std::max(brightest, static_cast<double>(b[i]));
        worst = std::max(worst, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
      }
    }
    EXPECT_GT(brightest, 0.3);
    // The deferred shading reads its materials from half floats.
    EXPECT_LT(worst, 2e-3);
  }
}

TEST_F(LightRaysTest, NoRayOfTheDefaultMethodIsWrong) {
  for (const char* name : {"teapot", "atrium", "rods", "sphere"}) {
    SCOPED_TRACE(name);
    *counts_ = {};
    const Scene scene = makeBuiltin(name).scene;
    Settings wanted = settings();
    wanted.trace.method = "witnessed";
    draw(scene, scene.cameras.front(), wanted, kWidth, kHeight);
    const Witness& seen = (*counts_)[RAY_SHADOW];
    EXPECT_GT(seen.rays, 1000u);
    EXPECT_GT(seen.hits, 20u);
    EXPECT_EQ(seen.falseOcclusion, 0u) << "of " << seen.rays;
    EXPECT_EQ(seen.falseVisibility, 0u) << "of " << seen.rays;
  }
}

TEST_F(LightRaysTest, AConvexBodyDoesNotShadowItself) {
  Scene scene;
  scene.sky = blackSky();
  addBox(scene, vec3(-1), vec3(1), addMaterial(scene, diffuse(vec3(0.8f))));
  scene.lights = {sun({-0.3f, -1, -0.4f}, 2), lampAt({1.5f, 2.5f, 1.5f}, 5)};
  *counts_ = {};
  Settings wanted = settings();
  wanted.trace.method = "witnessed";
  draw(scene, lookAt({2.2f, 1.9f, 2.5f}, vec3(0)), wanted, kWidth, kHeight);
  const Witness& seen = (*counts_)[RAY_SHADOW];
  EXPECT_GT(seen.rays, 500u);
  EXPECT_EQ(seen.hits + seen.falseOcclusion, 0u);
}

TEST_F(LightRaysTest, KeptFramesGiveTheSameBitsAndExactRaysTheSamePicture) {
  Scene scene = soup(120);
  Light ball = lampAt({1, 2.5f, 1.5f}, 5);
  ball.type = LightType::sphere;
  ball.radius = 0.3f;
  scene.lights = {sun({-0.3f, -1, -0.4f}, 2), ball};
  Renderer renderer = makeRenderer(scene);
  const Settings wanted = settings({{"trace.bounces", "2"}});
  const Frame first = drawWith(renderer, kAbove, wanted, kWidth, kHeight);
  const Frame kept = drawWith(renderer, kAbove, wanted, kWidth, kHeight);
  const Frame exact = see(scene, kAbove, {{"trace.bounces", "2"}, {"trace.method", "exact"}});
  EXPECT_EQ(first.plane("G"), kept.plane("G"));
  EXPECT_GT(first.report.rays[RAY_SHADOW], 10000u);
  EXPECT_EQ(first.report.rays, kept.report.rays);
  double worst = 0;
  const std::vector<float> a = first.plane("G"), b = exact.plane("G");
  for (std::size_t i = 0; i < a.size(); ++i)
    worst = std::max(worst, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
  EXPECT_LT(worst, 1e-4) << "over exact rays";  // whose barycentrics differ in the last place
}

TEST_F(LightRaysTest, ALargePictureComesInBandsAndLacksNothing) {
  Scene scene = soup(60);
  scene.lights = {sun({-0.3f, -1, -0.4f}, 2), lampAt({1, 2.5f, 1.5f}, 5)};
  constexpr int kWide = 1100, kHigh = 500;
  static_assert(kWide * kHigh > static_cast<int>(LightRays::kRaysAtOnce));
  const Frame found = draw(scene, kAbove, settings(), kWide, kHigh);
  const Frame expected = draw(scene, kAbove, settings({{"trace.effect", "whitted"}}), kWide, kHigh);
  const std::vector<float> a = found.plane("G"), b = expected.plane("G");
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < a.size(); ++i) wrong += std::abs(a[i] - b[i]) > 2e-3f;
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(found.report.overflow, 0u);
  EXPECT_GT(found.report.rays[RAY_SHADOW], 300000u);
}

TEST_F(LightRaysTest, NoMapsOfLightsAreDrawn) {
  Scene scene = soup(50);
  scene.lights = {sun({-0.3f, -1, -0.4f}, 2), lampAt({1, 2.5f, 1.5f}, 5)};
  const Frame rays = see(scene, kAbove, {{"shadow.resolution", "256"}});
  const Frame maps = see(scene, kAbove, {{"shadow.resolution", "256"}, {"shadow.method", "maps"}});
  EXPECT_EQ(maps.report.rays[RAY_SHADOW], 0u);
  EXPECT_GE(maps.report.memory.shadowMaps, rays.report.memory.shadowMaps + 7 * 256 * 256 * 4);
  EXPECT_EQ(rays.report.warnings.size(), 0u);
}

TEST_F(LightRaysTest, WhoCannotHaveThemIsTold) {
  Scene scene = soup(50);
  scene.lights = {sun({-0.3f, -1, -0.4f}, 2)};
  for (const auto& [setting, value] : {std::pair("trace.effect", "occlusion"), std::pair("trace.method", "none")}) {
    const Frame frame = see(scene, kAbove, {{setting, value}});
    ASSERT_EQ(frame.report.warnings.size(), 1u) << setting;
    EXPECT_NE(frame.report.warnings[0].find("shadow maps are used"), std::string::npos);
  }
}

}  // namespace
}  // namespace halfsilver::testing
