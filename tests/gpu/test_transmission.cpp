// Clear surfaces in pictures that blend deferred shading and reflections, against what optics says of them.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <halfsilver/builtin.h>
#include "gpu/light_fixture.h"
#include "gpu/small_blocks.h"
#include "gpu/tracing_scenes.h"
#include "gpu/transmission_fixture.h"

namespace halfsilver::testing {
namespace {

using glm::dvec3;
using glm::vec3;
bool warnsOf(const Frame& frame, const char* what) {
  return std::any_of(frame.report.warnings.begin(), frame.report.warnings.end(),
                     [what](const std::string& warning) { return warning.find(what) != std::string::npos; });
}

void expectEqualLayers(const Frame& found, const Frame& expected) {
  ASSERT_EQ(found.layers.channels, expected.layers.channels);
  EXPECT_EQ(found.layers.data, expected.layers.data);
}

TEST_F(TransmissionTest, ASlabShiftsWhatIsBehindItAsSnellSaysAndDimsItAsFresnelSays) {
  const Frame frame = see(slabOverFloor(glass(1.5f, 0.4f)), kOverSlab);
  double steepest = 1, mostShift = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const dvec3 way = ray(kOverSlab, x, y), eye(kOverSlab.eye);
      if (way.y > -0.25) continue;
      const double cosine = -way.y, sine = std::sqrt(1 - cosine * cosine);
      const double inside = std::sqrt(1 - sine * sine / 2.25);
      const double along = (eye.y - kHigh + kLow) / cosine * sine + (kHigh - kLow) / inside * sine / 1.5;
      const dvec3 place = dvec3(eye.x, 0, eye.z) + along / sine * dvec3(way.x, 0, way.z);
      const vec3 found = light(frame, x, y);
      ASSERT_NEAR(found.b, std::pow(1 - reflectance(cosine, 1 / 1.5), 2), 2e-4) << x << " " << y;
      ASSERT_NEAR((found.r / found.b - 0.5f) * kSpan, place.x, 3e-4) << x << " " << y;
      ASSERT_NEAR((found.g / found.b - 0.5f) * kSpan, place.z, 3e-4) << x << " " << y;
      steepest = std::min(steepest, cosine);
      mostShift = std::max(mostShift, glm::distance(place, eye - eye.y / way.y * way));
    }
  EXPECT_LT(steepest, 0.3);
  EXPECT_GT(mostShift, 0.5);
  EXPECT_TRUE(frame.report.warnings.empty()) << frame.report.warnings.front();
}

// A thin wall straight on and at 60 degrees: over black it shows what it reflects, under black what it lets through.
TEST_F(TransmissionTest, ReflectsAndLetsThroughWhatFresnelSays) {
  const auto seen = [this](const Camera& camera, float sky, float below) {
    Scene scene;
    scene.sky = evenSky(vec3(sky));
    addQuad(scene, {0, 0, 0}, {90, 0, 0}, {0, 0, -90}, addMaterial(scene, unlit(vec3(below))));
    addQuad(scene, {0, 1, 0}, {90, 0, 0}, {0, 0, -90}, addMaterial(scene, glass(1.5f, 0)));
    const int size = 33;
    return draw(scene, camera, settings(), size, size).at(size / 2, size / 2, "G");
  };
  const Camera down = lookAt({0, 3, 0}, {0, 1, 0}), slanting = lookAt({0, 2, std::sqrt(3.0f)}, {0, 1, 0});
  EXPECT_NEAR(seen(down, 1, 0), 0.04, 1e-4);
  EXPECT_NEAR(seen(down, 0, 1), 0.96, 1e-4);
  const double share = reflectance(0.5, 1 / 1.5);
  EXPECT_NEAR(share, 0.0892, 1e-4);
  EXPECT_NEAR(seen(slanting, 1, 0), share, 2e-4);
  EXPECT_NEAR(seen(slanting, 0, 1), 1 - share, 2e-4);
}

TEST_F(TransmissionTest, AVolumeAbsorbsByTheRaysOwnWayAndTintsWhereItIsEnteredAndLeft) {
  Material material = glass(1.5f, 0.4f);
  material.baseColor = {0.9f, 1, 1, 1};
  material.attenuationColor = {0.3f, 0.6f, 0.9f};
  material.attenuationDistance = 0.5f;
  const Frame frame = see(slabOverFloor(material), kOverSlab);
  const Frame clear = see(slabOverFloor(glass(1.5f, 0.4f)), kOverSlab);
  int compared = 0;
  for (int y = 0; y < kHeight; y += 3)
    for (int x = 0; x < kWidth; x += 3) {
      const dvec3 way = ray(kOverSlab, x, y);
      if (way.y > -0.25) continue;
      const double inside = (kHigh - kLow) / std::sqrt(1 - (1 - way.y * way.y) / 2.25);
      const double passes = std::pow(1 - reflectance(-way.y, 1 / 1.5), 2);
      const vec3 found = light(frame, x, y);
      EXPECT_NEAR(found.b, passes * std::pow(0.9, inside / 0.5), 2e-4);
      EXPECT_NEAR(found.r / light(clear, x, y).r, 0.81 * std::pow(0.3, inside / 0.5), 2e-4);
      ++compared;
    }
  EXPECT_GT(compared, 200);
}

// On the floor, without a way out behind it.
TEST_F(TransmissionTest, WhatLiesInsideOfAVolumeIsSeenThroughIt) {
  Scene scene;
  scene.sky = blackSky();
  Material amber = glass(1, 1);
  amber.attenuationColor = {0.8f, 0.5f, 0.2f};
  amber.attenuationDistance = 1;
  addBox(scene, {-9, 0, -9}, {9, 2, 9}, addMaterial(scene, amber));
  addQuad(scene, {0, 1.25f, 0}, {8, 0, 0}, {0, 0, -8}, addMaterial(scene, unlit(vec3(1))));
  const vec3 found = middle(see(scene, lookAt({0, 4, 0}, {0, 0, 0})));
  EXPECT_NEAR(found.r, std::pow(0.8, 0.75), 1e-3);
  EXPECT_NEAR(found.b, std::pow(0.2, 0.75), 1e-3);
}

TEST_F(TransmissionTest, AThinWallReflectsAndTintsOnceAndBendsNothing) {
  Material material = glass(1.5f, 0);
  material.baseColor = {0.5f, 0.7f, 0.9f, 1};
  material.attenuationColor = vec3(0.1f);
  material.attenuationDistance = 0.01f;
  const Frame frame = see(slabOverFloor(material), kOverSlab);
  for (int y = 0; y < kHeight; y += 3)
    for (int x = 0; x < kWidth; x += 3) {
      const dvec3 way = ray(kOverSlab, x, y);
      if (way.y > -0.25) continue;
      const dvec3 place = dvec3(kOverSlab.eye) - static_cast<double>(kOverSlab.eye.y) / way.y * way;
      const double passes = 1 - reflectance(-way.y, 1 / 1.5);
      EXPECT_NEAR(light(frame, x, y).b, 0.9 * passes, 2e-4);
      EXPECT_NEAR(light(frame, x, y).r, 0.5 * passes * (0.5 + place.x / kSpan), 2e-4);
    }
}

// Half of what enters passes, the rest is scattered back; metal lets nothing pass.
TEST_F(TransmissionTest, OnlyItsShareOfADielectricIsClear) {
  const auto seen = [this](float metallic) {
    Material material = glass(1.5f, 0);
    material.baseColor = {0.8f, 0.8f, 0.8f, 1};
    material.transmission = 0.5f;
    material.metallic = metallic;
    Scene scene = slabOverFloor(material);
    scene.lights = {sun({0, -1, 0}, 1)};
    return middle(see(scene, lookAt({0, 2.9f, 2}, {0, 0.9f, 0})));  // beside the sun's highlight
  };
  const double enters = 1 - reflectance(std::sqrt(0.5), 1 / 1.5);
  EXPECT_NEAR(seen(0).b / enters, 0.5 * 0.8 + 0.5 * 0.8 / 3.14159, 2e-3);
  EXPECT_LT(seen(1).b, 1e-3);
}

// Under an even sky what a pane reflects, passes and scatters adds up to what arrives, however rough or metallic it is.
TEST_F(TransmissionTest, AWhiteFurnaceStaysWhite) {
  for (const char* glossy : {"false", "true"})
    for (const float metallic : {0.0f, 0.5f, 1.0f})
      for (const float roughness : {0.0f, 0.5f, 1.0f})
        for (const float degrees : {0.0f, 60.0f, 75.0f}) {
          Material material = glass(1.5f, 0);
          material.baseColor = glm::vec4(1);
          material.metallic = metallic;
          material.roughness = roughness;
          material.doubleSided = true;
          Scene scene;
          scene.sky = evenSky(vec3(1));
          addQuad(scene, {0, 0, 0}, {40, 0, 0}, {0, 0, -40}, addMaterial(scene, material));
          const float angle = glm::radians(degrees);
          const Camera camera = lookAt({2 * std::sin(angle), 2 * std::cos(angle), 0.01f}, {0, 0, 0});
          const vec3 found = middle(see(scene, camera, {{"effect.glossy", glossy}, {"effect.samples", "16"}}));
          SCOPED_TRACE(std::string(glossy) + " " + std::to_string(metallic) + " " + std::to_string(roughness) + " " +
                       std::to_string(degrees));
          EXPECT_LE(found.g, 1.002f);
          // Rough metal keeps what its facets hide from each other, and what grazing facets reflect less of the sky.
          if ((metallic == 0 && *glossy == 'f') || roughness == 0) {
            EXPECT_NEAR(found.g, 1, 2e-3);
          }
        }
}

// Into a mirror that shows a pane before a wall, on every method whose rays may start there.
TEST_F(TransmissionTest, IsSeenInMirrorsOnAllMethods) {
  Material pane = glass(1.5f, 0);
  pane.baseColor = {0.5f, 0.7f, 0.9f, 1};
  pane.doubleSided = true;
  Scene scene;
  scene.sky = blackSky();
  Material all = mirrorMaterial();
  all.mirror = 1.0f;
  addQuad(scene, {0, 0, -2}, {9, 0, 0}, {0, 9, 0}, addMaterial(scene, all));
  addQuad(scene, {0, 0, 1}, {9, 0, 0}, {0, 9, 0}, addMaterial(scene, pane));
  addQuad(scene, {0, 0, 2}, {9, 0, 0}, {0, -9, 0}, addMaterial(scene, unlit(vec3(1))));
  for (const char* method : {"identity", "exact", "bvh", "screen-first", "attributes"}) {
    SCOPED_TRACE(method);
    const Frame frame = see(scene, lookAt({0, 0, 0}, {0, 0, -1}), {{"trace.method", method}, {"trace.bounces", "1"}});
    EXPECT_NEAR(middle(frame).r, 0.96 * 0.5, 3e-3);
    EXPECT_NEAR(middle(frame).b, 0.96 * 0.9, 3e-3);
    EXPECT_GE(frame.report.rays[RAY_REFRACTION], kPixels / 2);
    EXPECT_EQ(frame.report.rays[RAY_REFLECTION], frame.report.selected) << "refraction costs no bounce";
  }
}

// Into the side of a long block: what goes down is reflected by its bottom as a whole, and nothing of what lies below
// is seen; at the far end it comes out as it went in.
TEST_F(TransmissionTest, RaysInsideAreTotallyReflected) {
  Scene scene;
  scene.sky = blackSky();
  addBox(scene, {-6, 0, -40}, {0, 2, 40}, addMaterial(scene, glass(1.5f, 1)));
  addQuad(scene, {-3, -0.5f, 0}, {3, 0, 0}, {0, 0, -40}, addMaterial(scene, unlit({1, 0, 0})));
  addQuad(scene, {-7, 1, 0}, {0, 0, -40}, {0, 40, 0}, addMaterial(scene, unlit({0, 0, 1})));
  const Camera camera = lookAt({1, 1.1f, 0}, {0, 1, 0});
  const Frame frame = see(scene, camera);
  int inside = 0, reflected = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const dvec3 way = ray(camera, x, y), entry = dvec3(camera.eye) + way / -way.x;
      if (entry.y < 0.05 || entry.y > 1.95) continue;
      const vec3 found = light(frame, x, y);
      ASSERT_NEAR(found.b, std::pow(1 - reflectance(-way.x, 1 / 1.5), 2), 1e-3) << x << " " << y;
      ASSERT_NEAR(found.r, 0, 1e-6);
      ++inside;
      const double down = way.y / 1.5 / std::sqrt(1 - (1 - way.x * way.x) / 2.25);
      if (entry.y + 6 * down < -0.1) ++reflected;
    }
  EXPECT_GT(inside, 1000);
  EXPECT_GT(reflected, 200);
}

TEST_F(TransmissionTest, APathHasABoundOfItsOwnForClearSurfaces) {
  const auto panes = [this](int count) {
    Scene scene;
    scene.sky = blackSky();
    Material pane = glass(1, 0);
    pane.baseColor = {0.9f, 0.9f, 0.9f, 1};
    const std::uint32_t material = addMaterial(scene, pane);
    for (int i = 0; i < count; ++i) addQuad(scene, {0, 0, -static_cast<float>(i)}, {20, 0, 0}, {0, 20, 0}, material);
    addQuad(scene, {0, 0, -12}, {30, 0, 0}, {0, 30, 0}, addMaterial(scene, unlit(vec3(1))));
    return see(scene, lookAt({0.5f, 0.3f, 3}, {0.5f, 0.3f, 0}), {{"trace.bounces", "1"}});
  };
  const Frame all = panes(8);
  EXPECT_NEAR(middle(all).g, std::pow(0.9, 8), 1e-4);
  EXPECT_GE(all.report.rays[RAY_REFRACTION], 8 * kPixels);
  EXPECT_NEAR(middle(panes(9)).g, 0, 1e-6) << "there the sky stands in";
}

// To the selection and to the layers of the mirror ray refractions are nothing.
TEST_F(TransmissionTest, RefractionsAreNoReflections) {
  const Scene scene = slabOverFloor(glass(1.5f, 0.4f));
  const Frame whole = see(scene, kOntoSlab, {{"trace.tally", "true"}});
  EXPECT_EQ(whole.report.selected, kPixels);
  EXPECT_EQ(whole.report.rays[RAY_REFLECTION], kPixels);
  EXPECT_EQ(whole.report.rays[RAY_REFRACTION], 2 * kPixels);
  EXPECT_EQ(whole.at(20, 20, "rays.refraction"), 2);
  EXPECT_EQ(whole.at(20, 20, "hits.refraction"), 2);
  EXPECT_EQ(whole.at(20, 20, "hit.T"), -1) << "the mirror ray meets the sky";
  const Frame fewer = see(scene, kOntoSlab, {{"select.fraction", "0"}});
  EXPECT_EQ(fewer.report.selected, 0u);
  EXPECT_EQ(fewer.report.rays[RAY_REFLECTION], 0u);
  EXPECT_EQ(fewer.report.rays[RAY_REFRACTION], 2 * kPixels);
  EXPECT_EQ(fewer.at(20, 20, "hit.T"), -2);
  EXPECT_EQ(light(fewer, 20, 20), light(whole, 20, 20)) << "nothing but a black sky is reflected";
}

// What is behind glass is lit as it is without: by maps, and by rays.
TEST_F(TransmissionTest, WhatIsBehindIsLitByMapsAndByRays) {
  for (const char* shadows : {"maps", "rays", "refined"})
    for (const char* method : {"identity", "exact"}) {
      SCOPED_TRACE(std::string(shadows) + " " + method);
      const auto seen = [&](bool glazed) {
        Scene scene;
        scene.sky = blackSky();
        addQuad(scene, {0, 0, 0}, {9, 0, 0}, {0, 9, 0}, addMaterial(scene, diffuse(vec3(0.8f))));
        if (glazed) addQuad(scene, {0, 0, 1}, {9, 0, 0}, {0, 9, 0}, addMaterial(scene, glass(1.5f, 0)));
        scene.lights = {bulb({0, 0, 0.5f}, 1)};  // between them
        return middle(see(scene, lookAt({0.2f, 0, 3}, {0.2f, 0, 0}),
                          {{"shadow.method", shadows}, {"trace.method", method}, {"shadow.resolution", "256"}}));
      };
      const double bare = seen(false).g;
      EXPECT_GT(bare, 0.3);
      EXPECT_NEAR(seen(true).g / bare, 0.96, 2e-3);
    }
}

TEST_F(TransmissionTest, NoRayOfTheDefaultMethodIsWrong) {
  for (const char* name : {"triangles", "glass"}) {
    SCOPED_TRACE(name);
    const bool made = std::string(name) == "triangles";
    const Scene scene = made ? glassAmongTriangles() : makeBuiltin(name).scene;
    *counts_ = {};
    Settings wanted = settings({{"trace.bounces", "3"}, {"shadow.method", "rays"}});
    wanted.trace.method = "witnessed";
    draw(scene, made ? kAbove : scene.cameras.front(), wanted, kWidth, kHeight);
    for (const int kind : {RAY_REFLECTION, RAY_REFRACTION, RAY_SHADOW}) {
      const Witness& seen = (*counts_)[static_cast<std::size_t>(kind)];
      EXPECT_GT(seen.rays, 200u) << "kind " << kind;
      EXPECT_EQ(seen.wrong(), 0u) << "kind " << kind << " of " << seen.rays;
    }
  }
}

TEST_F(TransmissionTest, PicturesOverTheDefaultAndOverExactRaysAreEqual) {
  const Scene scene = glassAmongTriangles();
  const Pairs exactly = {{"trace.method", "exact"}, {"trace.bounces", "3"}};
  const Frame exact = see(scene, kAbove, exactly), lists = see(scene, kAbove, {{"trace.bounces", "3"}});
  for (const char* channel : {"R", "G", "B"}) EXPECT_EQ(exact.plane(channel), lists.plane(channel)) << channel;
  EXPECT_GT(lists.report.rays[RAY_REFRACTION], 500u);
}

// Whether rays come in one batch or in several, a frame after another or two at once.
TEST_F(TransmissionTest, BatchesAndFramesUnderWayChangeNothing) {
  const Scene scene = glassAmongTriangles();
  constexpr int width = 240, height = 144;
  static_assert(width * height * sizeof(shared::Ray) > kSmallBlock, "one batch would do");
  for (const char* shadows : {"maps", "rays"}) {
    SCOPED_TRACE(shadows);
    const Settings wanted = settings({{"shadow.method", shadows}});
    const Frame whole = draw(scene, kAbove, wanted, width, height);
    EXPECT_GT(whole.report.rays[RAY_REFRACTION], 500u);
    if (shadows == std::string("maps")) {
      Renderer renderer(withSmallBlocks(context.getProcAddress()), methods(scene));
      renderer.setScene(scene);
      const Frame parts = drawWholeWith(renderer, kAbove, wanted, width, height);
      for (const char* channel : {"R", "G", "B"}) EXPECT_EQ(parts.plane(channel), whole.plane(channel)) << channel;
      EXPECT_EQ(parts.report.rays, whole.report.rays);
    }

    Renderer two = makeRenderer(scene);
    drawWholeWith(two, kAbove, wanted, width, height);
    const gl::Texture color(api, {.format = GL_RGBA8, .width = width, .height = height}, "test picture");
    const gl::Framebuffer framebuffer(api);
    framebuffer.attach(GL_COLOR_ATTACHMENT0, color);
    const Target target{framebuffer.name(), 0, 0, width, height};
    two.begin(kOntoSlab, wanted, width, height);
    two.begin(kAbove, wanted, width, height);
    two.finish(target);
    two.finish(target);
    expectEqualLayers({two.readLayers(), two.report()}, whole);
  }
}

// A clear coat over glass reflects, and takes from what is seen through it.
TEST_F(TransmissionTest, ACoatLiesOverIt) {
  Material material = glass(1, 0);
  material.coat = 0.5f;
  EXPECT_NEAR(middle(see(slabOverFloor(material), lookAt({0, 3, 0}, {0, 0.9f, 0}))).b, 0.98, 1e-3);
}

// In a mirror, a pane that is black and too rough to be traced.
TEST_F(TransmissionTest, NoRayIsSentForNothing) {
  for (const float tint : {0.0f, 0.5f}) {
    Material pane = glass(1.5f, 0);
    pane.baseColor = {tint, tint, tint, 1};
    pane.roughness = 1;
    pane.doubleSided = true;
    Scene scene;
    scene.sky = evenSky(vec3(1));
    addQuad(scene, {0, 0, -2}, {9, 0, 0}, {0, 9, 0}, addMaterial(scene, mirrorMaterial()));
    addQuad(scene, {0, 0, 1}, {9, 0, 0}, {0, 9, 0}, addMaterial(scene, pane));
    const Frame frame = see(scene, lookAt({0, 0, 0}, {0, 0, -1}));
    EXPECT_EQ(frame.report.rays[RAY_REFRACTION], tint > 0 ? kPixels : 0u);
  }
}

// One that blends covers by its alpha what is seen through it.
TEST_F(TransmissionTest, AlphaCoversWhatIsClear) {
  Material material = glass(1, 0);
  material.alphaMode = AlphaMode::blend;
  material.baseColor = {0.5f, 0.5f, 0.5f, 0.25f};
  EXPECT_NEAR(middle(see(slabOverFloor(material), lookAt({0, 3, 0}, {0, 0.9f, 0}))).b, 0.25 * 0.5 + 0.75, 1e-3);
}

// Rough glass is as clear as smooth one; what is traced of its reflection is spread, and its light is counted once.
TEST_F(TransmissionTest, GlossyFramesSeeThrough) {
  Material material = glass(1.5f, 0);
  material.roughness = 0.3f;
  const Scene scene = slabOverFloor(material);
  const Camera camera = lookAt({0, 3, 0}, {0, 0.9f, 0});
  const Frame glossy = see(scene, camera, {{"effect.glossy", "true"}, {"effect.samples", "4"}});
  EXPECT_NEAR(middle(glossy).b, 0.96, 2e-3);
  EXPECT_EQ(glossy.report.rays[RAY_REFRACTION], kPixels);
  EXPECT_NEAR(middle(see(scene, camera)).b, 0.96, 2e-3);
}

TEST_F(TransmissionTest, SaysWhatItDoesNotShow) {
  Material material = glass(1.5f, 0.4f);
  const Scene plainGlass = slabOverFloor(material);
  for (const char* effect : {"reflection", "whitted", "path", "occlusion"}) {
    const Frame frame = see(plainGlass, kOntoSlab, {{"trace.effect", effect}});
    EXPECT_FALSE(warnsOf(frame, "transmit")) << effect;
    EXPECT_FALSE(warnsOf(frame, "dispersion")) << effect;
  }
  EXPECT_TRUE(warnsOf(see(plainGlass, kOntoSlab, {{"trace.effect", "layers"}}), "transmit"));
  for (const char* method : {"none", "planar", "cubemap", "screen-space"})
    EXPECT_TRUE(warnsOf(see(plainGlass, kOntoSlab, {{"trace.method", method}}), "transmit")) << method;
  EXPECT_TRUE(warnsOf(see(plainGlass, kOntoSlab, {{"select.mode", "none"}}), "transmit"));
  material.dispersion = 1;
  const Scene flint = slabOverFloor(material);
  const Frame frame = see(flint, kOntoSlab);
  EXPECT_TRUE(warnsOf(frame, "dispersion"));
  EXPECT_FALSE(warnsOf(frame, "transmit"));
  EXPECT_FALSE(warnsOf(see(flint, kOntoSlab, {{"trace.effect", "whitted"}}), "dispersion"));
}

}  // namespace
}  // namespace halfsilver::testing
