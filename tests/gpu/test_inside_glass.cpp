// Clear volumes with the eye inside, against what optics says of them.
#include <cmath>

#include "gpu/light_fixture.h"
#include "gpu/tracing_scenes.h"
#include "gpu/transmission_fixture.h"

namespace halfsilver::testing {
namespace {

using glm::vec3;
using InsideGlassTest = TransmissionTest;

// A meter of it under an even sky, above a floor that takes what its border reflects.
Scene pool(const Material& volume, const Material& floor) {
  Scene scene;
  scene.sky = evenSky(vec3(1));
  addBox(scene, {-40, 0, -40}, {40, 1, 40}, addMaterial(scene, volume));
  addQuad(scene, {0, 0.1f, 0}, {39, 0, 0}, {0, 0, -39}, addMaterial(scene, floor));
  return scene;
}

// Lets through, of red and blue, 0.8 and 0.2 in two meters.
Material amber() {
  Material material = glass(1.5f, 1);
  material.attenuationColor = {0.8f, 0.5f, 0.2f};
  material.attenuationDistance = 2;
  return material;
}

Camera fromInside(const vec3& target) {
  Camera camera = lookAt({0, 0.5f, 0}, target);
  camera.nearPlane = 0.01f;
  return camera;
}

TEST_F(InsideGlassTest, LightInsideGlassLeavesItAsFresnelSaysUpToTheCriticalAngle) {
  const Scene scene = pool(glass(1.5f, 1), unlit(vec3(0)));  // takes what is reflected
  const Camera camera = fromInside({1, 1.6f, 0});
  const Frame frame = see(scene, camera, {{"select.mode", "all"}});
  int total = 0, partial = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double cosine = ray(camera, x, y).y;
      if (cosine < 0.3) continue;
      ASSERT_NEAR(light(frame, x, y).g, 1 - reflectance(cosine, 1.5), 1e-3) << x << " " << y << " " << cosine;
      ++(reflectance(cosine, 1.5) == 1 ? total : partial);
    }
  EXPECT_GT(total, 300);
  EXPECT_GT(partial, 1000);
}

// A reflectance of 0.04 straight on stays below that threshold; what is reflected as a whole does not.
TEST_F(InsideGlassTest, TotalReflectionIsTracedWhateverIsSelected) {
  const Scene scene = pool(glass(1.5f, 1), unlit({0, 0.25f, 0}));
  const Camera camera = fromInside({1, 0.9f, 0});
  const Frame frame = see(scene, camera, {{"select.min_reflectivity", "0.05"}});
  EXPECT_EQ(middle(frame), vec3(0, 0.25f, 0));
  EXPECT_GT(frame.report.selected, 100u);
  EXPECT_LT(frame.report.selected, kPixels);
}

TEST_F(InsideGlassTest, AnEyeInsideOfAVolumeSeesWhatItsBorderReflectsAbsorbedBothWays) {
  const Scene scene = pool(amber(), unlit(vec3(1)));
  const Camera camera = fromInside({1, 1.1f, 0});
  const Frame frame = see(scene, camera);
  int total = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double cosine = ray(camera, x, y).y;
      if (cosine < 0.2 || reflectance(cosine, 1.5) < 1) continue;
      const double way = (0.5 + 0.9) / cosine;  // up, and down to what lies inside
      ASSERT_NEAR(light(frame, x, y).r, std::pow(0.8, way / 2), 1e-3) << x << " " << y;
      ASSERT_NEAR(light(frame, x, y).b, std::pow(0.2, way / 2), 1e-3) << x << " " << y;
      ++total;
    }
  EXPECT_GT(total, 300);
}

// The same where rays find the shadows of what is reflected.
TEST_F(InsideGlassTest, LightByRaysIsAbsorbedOnItsWayToAnEyeInside) {
  Material matte;
  matte.roughness = 1;
  matte.metallic = 0;
  Scene scene = pool(amber(), matte);
  scene.sky = blackSky();
  scene.lights = {sun({0, -1, 0}, 8)};
  const Camera camera = fromInside({1, 1.1f, 0});
  const Pairs byRays = {{"shadow.method", "rays"}};
  const vec3 found = middle(see(scene, camera, byRays));
  const vec3 expected = middle(draw(scene, camera, settingsWith({{"trace.effect", "whitted"}}), kWidth, kHeight));
  EXPECT_GT(expected.r, 0.2f);
  EXPECT_NEAR(found.r, expected.r, 2e-3);
  EXPECT_NEAR(found.b, expected.b, 2e-3);
}

TEST_F(InsideGlassTest, AVolumesCoatIsOnItsOutside) {
  Material material = glass(1, 1);
  material.coat = 1;
  const Scene scene = pool(material, unlit(vec3(0)));
  EXPECT_NEAR(middle(see(scene, fromInside({0.1f, 1, 0}))).g, 1, 1e-3) << "from inside";
  EXPECT_NEAR(middle(see(scene, lookAt({0, 3, 0}, {0.1f, 0, 0}))).g, 0.04, 1e-3) << "from outside";
}

}  // namespace
}  // namespace halfsilver::testing
