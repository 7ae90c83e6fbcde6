// Whitted's rays against what optics says of glass in simple shapes.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <memory>

#include <halfsilver/builtin.h>
#include "gpu/glass_scenes.h"
#include "gpu/light_fixture.h"
#include "gpu/ray_witness.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

using glm::dvec3;
using glm::vec3;

constexpr int kWidth = 64, kHeight = 48;

dvec3 pixelRay(const Camera& camera, int x, int y) { return testing::pixelRay(camera, x, y, kWidth, kHeight); }

class WhittedTest : public WitnessTest {
 protected:
  static Settings settings(std::initializer_list<std::pair<const char*, const char*>> more = {}) {
    Settings result = settingsWith({{"trace.effect", "whitted"}, {"select.mode", "all"}, {"trace.bounces", "3"}});
    for (const auto& [name, value] : more) set(result, name, value);
    return result;
  }
  Frame see(const Scene& scene, const Camera& camera,
            std::initializer_list<std::pair<const char*, const char*>> more = {}) {
    const Frame frame = draw(scene, camera, settings(more), kWidth, kHeight);
    EXPECT_EQ(frame.report.overflow, 0u);
    return frame;
  }
  static vec3 light(const Frame& frame, int x, int y) {
    return {frame.at(x, y, "reflection.R"), frame.at(x, y, "reflection.G"), frame.at(x, y, "reflection.B")};
  }
};

TEST_F(WhittedTest, ASlabShiftsWhatIsBehindItAsSnellSaysAndDimsItAsFresnelSays) {
  const Frame frame = see(slabOverFloor(glass(1.5f, 0.4f)), kOverSlab, {{"trace.bounces", "2"}});
  double steepest = 1, mostShift = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const dvec3 ray = pixelRay(kOverSlab, x, y), eye(kOverSlab.eye);
      if (ray.y > -0.25) continue;
      const double cosine = -ray.y, inside = std::sqrt(1 - (1 - cosine * cosine) / 2.25);
      const dvec3 across = dvec3(ray.x, 0, ray.z) / std::sqrt(1 - cosine * cosine);
      const double outsideWay = (eye.y - kHigh + kLow) / cosine * std::sqrt(1 - cosine * cosine);
      const double insideWay = (kHigh - kLow) / inside * std::sqrt(1 - inside * inside);
      const dvec3 place = dvec3(eye.x, 0, eye.z) + (outsideWay + insideWay) * across;
      const double passes = std::pow(1 - reflectance(cosine, 1 / 1.5), 2);
      const vec3 found = light(frame, x, y);
      ASSERT_NEAR(found.b, passes, 2e-5) << x << " " << y;
      ASSERT_NEAR((found.r / found.b - 0.5f) * kSpan, place.x, 3e-4) << x << " " << y;
      ASSERT_NEAR((found.g / found.b - 0.5f) * kSpan, place.z, 3e-4) << x << " " << y;
      steepest = std::min(steepest, cosine);
      mostShift = std::max(mostShift, glm::distance(place, eye - eye.y / ray.y * ray));
    }
  EXPECT_LT(steepest, 0.3);
  EXPECT_GT(mostShift, 0.5);
}

TEST_F(WhittedTest, LightInsideGlassLeavesItAsFresnelSaysUpToTheCriticalAngle) {
  Scene scene;
  scene.sky = evenSky(vec3(1));
  addBox(scene, {-40, 0, -40}, {40, 1, 40}, addMaterial(scene, glass(1.5f, 1)));
  addQuad(scene, {0, 0.1f, 0}, {39, 0, 0}, {0, 0, -39}, addMaterial(scene, unlit(vec3(0))));  // takes what is reflected
  Camera camera = lookAt({0, 0.5f, 0}, {1, 1.6f, 0});
  camera.nearPlane = 0.01f;
  const Frame frame = see(scene, camera);
  int total = 0, partial = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double cosine = pixelRay(camera, x, y).y;
      if (cosine < 0.3) continue;
      ASSERT_NEAR(light(frame, x, y).g, 1 - reflectance(cosine, 1.5), 3e-4) << x << " " << y << " " << cosine;
      ++(reflectance(cosine, 1.5) == 1 ? total : partial);
    }
  EXPECT_GT(total, 300);
  EXPECT_GT(partial, 1000);
}

TEST_F(WhittedTest, GlassAbsorbsByTheRaysOwnWayInsideAndIsTintedWhereItIsEnteredAndLeft) {
  Material material = glass(1, 0.4f);
  material.baseColor = {0.9f, 1, 1, 1};
  material.attenuationColor = {0.3f, 0.6f, 0.9f};
  material.attenuationDistance = 0.5f;
  const Frame frame = see(slabOverFloor(material), kOverSlab);
  for (int y = 0; y < kHeight; y += 3)
    for (int x = 0; x < kWidth; x += 3) {
      const dvec3 ray = pixelRay(kOverSlab, x, y);
      if (ray.y > -0.25) continue;
      const double way = (kHigh - kLow) / -ray.y;
      const dvec3 place = dvec3(kOverSlab.eye) - static_cast<double>(kOverSlab.eye.y) / ray.y * ray;
      const vec3 found = light(frame, x, y);
      EXPECT_NEAR(found.b, std::pow(0.9, way / 0.5), 1e-5);
      EXPECT_NEAR(found.r, (0.5 + place.x / kSpan) * 0.81 * std::pow(0.3, way / 0.5), 3e-5);
    }
}

TEST_F(WhittedTest, AThinWallReflectsAndTintsOnceAndBendsNothing) {
  Material material = glass(1.5f, 0);
  material.baseColor = {0.5f, 0.7f, 0.9f, 1};
  material.attenuationColor = vec3(0.1f);
  material.attenuationDistance = 0.01f;
  const Frame frame = see(slabOverFloor(material), kOverSlab);
  for (int y = 0; y < kHeight; y += 3)
    for (int x = 0; x < kWidth; x += 3) {
      const dvec3 ray = pixelRay(kOverSlab, x, y);
      if (ray.y > -0.25) continue;
      const dvec3 place = dvec3(kOverSlab.eye) - static_cast<double>(kOverSlab.eye.y) / ray.y * ray;
      const double passes = 1 - reflectance(-ray.y, 1 / 1.5);
      EXPECT_NEAR(light(frame, x, y).b, 0.9 * passes, 2e-5);
      EXPECT_NEAR(light(frame, x, y).r, 0.5 * passes * (0.5 + place.x / kSpan), 3e-5);
    }
}

TEST_F(WhittedTest, AVolumeInsideAnotherAbsorbsInItsPlace) {
  const auto dark = [](const vec3& color) {
    Material material = glass(1, 1);
    material.attenuationColor = color;
    material.attenuationDistance = 1;
    return material;
  };
  Scene scene = slabOverFloor(dark({1, 1, 0.3f}));
  addBox(scene, {-8, 0.6f, -8}, {8, 0.75f, 8}, addMaterial(scene, dark({1, 1, 0.6f})));
  const Frame frame = see(scene, kOntoSlab, {{"trace.bounces", "4"}});
  for (int y = 0; y < kHeight; y += 3)
    for (int x = 0; x < kWidth; x += 3) {
      const double cosine = -pixelRay(kOntoSlab, x, y).y;
      EXPECT_NEAR(light(frame, x, y).b, std::pow(0.3, 0.25 / cosine) * std::pow(0.6, 0.15 / cosine), 2e-5);
    }
}

TEST_F(WhittedTest, ACoatIsAMirrorThatTakesFromWhatIsBelow) {
  Scene scene;
  scene.sky = evenSky(vec3(1));
  Material lacquer = unlit(vec3(0));
  lacquer.unlit = false;
  lacquer.specular = 0;
  lacquer.emissive = {0, 0, 1};
  lacquer.coat = 0.8f;
  addQuad(scene, vec3(0), {9, 0, 0}, {0, 0, -9}, addMaterial(scene, lacquer));
  const Frame frame = see(scene, kOverSlab);
  EXPECT_EQ(frame.report.rays[RAY_REFLECTION], frame.report.selected);
  for (int y = 0; y < kHeight; y += 3)
    for (int x = 0; x < kWidth; x += 3) {
      const dvec3 ray = pixelRay(kOverSlab, x, y);
      if (ray.y > -0.3) continue;
      const double film = 0.8 * reflectance(-ray.y, 1 / 1.5);
      EXPECT_NEAR(light(frame, x, y).r, film, 1e-5);
      EXPECT_NEAR(light(frame, x, y).b, film + (1 - film), 1e-5);
    }
}

TEST_F(WhittedTest, ColorsGoWaysOfTheirOwnThroughGlassThatDisperses) {
  Material material = glass(1.5f, 0.4f);
  material.dispersion = 2;
  const Frame frame = see(slabOverFloor(material), kOntoSlab, {{"trace.bounces", "2"}});
  const auto pixels = static_cast<std::uint64_t>(kWidth * kHeight);
  ASSERT_EQ(frame.report.selected, pixels);
  EXPECT_EQ(frame.report.rays[RAY_REFRACTION], 6 * pixels);  // three enter, three leave
  const double indices[3] = {1.475, 1.5, 1.525};
  for (int y = 0; y < kHeight; y += 3)
    for (int x = 0; x < kWidth; x += 3) {
      const dvec3 ray = pixelRay(kOntoSlab, x, y), eye(kOntoSlab.eye);
      for (int color : {0, 2}) {
        const double n = indices[color], cosine = -ray.y, sine2 = 1 - cosine * cosine;
        const double ways = (eye.y - kHigh + kLow) / cosine + (kHigh - kLow) / (n * std::sqrt(1 - sine2 / (n * n)));
        const double expected = color == 0 ? 0.5 + (eye.x + ways * ray.x) / kSpan : 1.0;
        EXPECT_NEAR(light(frame, x, y)[color], expected * std::pow(1 - reflectance(cosine, 1 / n), 2), 5e-5);
      }
    }
}

// Straight down on a white floor under a pane, seen from between them.
TEST_F(WhittedTest, ShadowsOfGlassHaveItsColor) {
  const auto lit = [&](const Material& pane) {
    Scene scene;
    scene.sky = blackSky();
    scene.lights = {sun({0, -1, 0}, 3)};
    addQuad(scene, vec3(0), {9, 0, 0}, {0, 0, -9}, addMaterial(scene, diffuse(vec3(1))));
    const auto slab = addMaterial(scene, pane);
    if (pane.transmission == 0 || pane.thickness > 0)
      addBox(scene, {-3, 1, -3}, {3, 1.4f, 3}, slab);
    else
      addQuad(scene, {0, 1, 0}, {3, 0, 0}, {0, 0, -3}, slab);
    return light(see(scene, lookAt({0, 0.9f, 0.2f}, {0, 0, 0})), kWidth / 2, kHeight / 2) * glm::pi<float>() / 3.0f;
  };
  Material pane = glass(1.5f, 0.4f);
  pane.baseColor = {0.5f, 1, 1, 1};
  pane.attenuationColor = {1, 0.25f, 1};
  pane.attenuationDistance = 0.2f;
  const vec3 thick = lit(pane);
  EXPECT_NEAR(thick.r, 0.25 * 0.96 * 0.96, 1e-4);
  EXPECT_NEAR(thick.g, 0.25 * 0.25 * 0.96 * 0.96, 1e-4);
  EXPECT_NEAR(thick.b, 0.96 * 0.96, 1e-4);
  pane.thickness = 0;
  pane.doubleSided = true;
  const vec3 thin = lit(pane);
  EXPECT_NEAR(thin.r, 0.5 * 0.96, 1e-4);
  EXPECT_NEAR(thin.b, 0.96, 1e-4);
  EXPECT_EQ(lit(plain(vec3(1))), vec3(0));
}

TEST_F(WhittedTest, BothChildrenOfAHitAreKeptToTheDepth) {
  const Scene scene = slabOverFloor(glass(1.5f, 0.4f));
  const auto pixels = static_cast<std::uint64_t>(kWidth * kHeight);
  const char* const depths[] = {"1", "2", "3"};
  for (std::uint64_t depth = 1; depth <= 3; ++depth) {
    const Frame frame = see(scene, kOntoSlab, {{"trace.bounces", depths[depth - 1]}});
    ASSERT_EQ(frame.report.selected, pixels);
    EXPECT_EQ(frame.report.rays[RAY_REFLECTION], depth * pixels);
    EXPECT_EQ(frame.report.rays[RAY_REFRACTION], depth * pixels);
  }
}

TEST_F(WhittedTest, AMirroredPathEndsAtTheDepth) {
  Scene scene;
  addBox(scene, vec3(-1), vec3(1), addMaterial(scene, mirrorMaterial()), true);
  scene.sky = evenSky({0.5f, 0.25f, 1});
  for (const char* depth : {"1", "4", "16"}) {
    const Frame frame = see(scene, lookAt({0.2f, 0.1f, 0.3f}, {1, 0.3f, 0.1f}), {{"trace.bounces", depth}});
    const std::uint64_t all = frame.report.selected * static_cast<std::uint64_t>(std::stoi(depth));
    EXPECT_LE(frame.report.rays[RAY_REFLECTION], all);
    EXPECT_GT(frame.report.rays[RAY_REFLECTION], all - all / 1000);  // but for those that start too near an edge
    EXPECT_NEAR(light(frame, 20, 20).g, 0.25f, 1e-5f);
  }
}

TEST_F(WhittedTest, NoLightLeaksIntoAClosedBox) {
  Scene scene;
  addBox(scene, vec3(-1), vec3(1), addMaterial(scene, plain(vec3(0.8f))), true);
  scene.sky = blackSky();
  Light lamp;
  lamp.type = LightType::point;
  lamp.position = {0.3f, 1.05f, 0.2f};
  lamp.intensity = 1e4f;
  scene.lights = {sun({0.2f, -1, 0.3f}, 1e5f), lamp};
  const Camera camera = lookAt({0.2f, 0.1f, 0.3f}, {1, -0.6f, 0.1f});
  const Frame frame = see(scene, camera);
  EXPECT_GT(frame.report.rays[RAY_SHADOW], 1000u);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) ASSERT_EQ(light(frame, x, y), vec3(0)) << x << " " << y;
  scene.lights[1].position = {0, 0.5f, 0};
  EXPECT_GT(light(see(scene, camera), 30, 30).g, 1) << "with the lamp inside";
}

// Walls side by side over a mirror, towards the sun: nothing hides it from what it lights.
TEST_F(WhittedTest, MirrorsShowWhatTheReflectionEffectShows) {
  Scene scene;
  scene.lights = {sun({0, -0.3f, -1}, 2)};
  addQuad(scene, vec3(0), {4, 0, 0}, {0, 0, -4}, addMaterial(scene, mirrorMaterial()));
  for (int i = -2; i <= 2; ++i) {
    Material wall = plain({0.3f + 0.1f * static_cast<float>(i), 0.5f, 0.4f});
    wall.roughness = 0.1f * static_cast<float>(i + 3);
    addQuad(scene, {1.1f * static_cast<float>(i), 0.6f, -1}, {0.5f, 0, 0}, {0, 0.5f, 0}, addMaterial(scene, wall));
  }
  const Camera camera = lookAt({0, 1.2f, 3}, {0, 0.3f, -1});
  const Frame whitted = see(scene, camera, {{"trace.bounces", "2"}});
  const Frame reflection =
      see(scene, camera, {{"trace.bounces", "2"}, {"trace.effect", "reflection"}, {"shadow.resolution", "512"}});
  const std::vector<float> found = whitted.plane("G"), expected = reflection.plane("G");
  const std::vector<float> selected = whitted.plane("selected.Y");
  int compared = 0, wrong = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (selected[i] == 0) continue;
    ++compared;
    wrong += std::abs(found[i] - expected[i]) > 2e-3f * (0.1f + expected[i]);
  }
  EXPECT_GT(compared, 1500);
  EXPECT_EQ(wrong, 0);
}

TEST_F(WhittedTest, NoRayOfTheDefaultMethodIsWrong) {
  for (const char* name : {"triangles", "sphere", "glass"}) {
    SCOPED_TRACE(name);
    const bool made = std::string(name) == "triangles";
    const Scene scene = made ? glassAmongTriangles() : makeBuiltin(name).scene;
    *counts_ = {};
    Settings wanted = settings();
    wanted.trace.method = "witnessed";
    draw(scene, made ? kAbove : scene.cameras.front(), wanted, kWidth, kHeight);
    for (const int kind : {RAY_REFLECTION, RAY_REFRACTION, RAY_SHADOW}) {
      const Witness& seen = (*counts_)[static_cast<std::size_t>(kind)];
      if (kind != RAY_REFRACTION || std::string(name) != "sphere") {
        EXPECT_GT(seen.rays, 200u) << "kind " << kind;
      }
      EXPECT_EQ(seen.wrong(), 0u) << "kind " << kind << " of " << seen.rays;
    }
  }
}

TEST_F(WhittedTest, PicturesOverTheDefaultAndOverExactRaysAreEqual) {
  const Scene scene = glassAmongTriangles();
  const Frame exact = see(scene, kAbove, {{"trace.method", "exact"}}), lists = see(scene, kAbove);
  for (const char* channel : {"reflection.R", "reflection.G", "reflection.B"})
    EXPECT_EQ(exact.plane(channel), lists.plane(channel)) << channel;
  EXPECT_GT(lists.report.rays[RAY_REFRACTION], 500u);
}

}  // namespace
}  // namespace halfsilver::testing
