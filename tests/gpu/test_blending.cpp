// Materials of AlphaMode::blend in pictures, in what mirrors show, and along paths.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "gpu/light_fixture.h"
#include "gpu/ray_witness.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

using glm::vec3;

constexpr int kWidth = 24, kHeight = 16;

Material glowing(const vec3& color, float alpha = 1) {
  Material material = plain(color);
  material.baseColor = {color, alpha};
  material.unlit = true;
  material.doubleSided = true;
  if (alpha < 1) material.alphaMode = AlphaMode::blend;
  return material;
}

// Across the z axis.
void addSheet(Scene& scene, float z, const Material& material, const vec3& half = vec3(9), float x = 0) {
  addQuad(scene, {x, 0, z}, {half.x, 0, 0}, {0, half.y, 0}, addMaterial(scene, material));
}

const Camera kAlongZ = lookAt({0, 0, 2}, {0, 0, 0});
const vec3 kBlue{0.2f, 0.2f, 1}, kWhite{1, 1, 1}, kRed{1, 0, 0}, kGreen{0, 1, 0};

class BlendingTest : public WitnessTest {
 protected:
  Frame see(const Scene& scene, std::initializer_list<std::pair<const char*, const char*>> settings = {}) {
    const Frame frame = draw(scene, kAlongZ, settingsWith(settings), kWidth, kHeight);
    EXPECT_EQ(frame.report.overflow, 0u);
    return frame;
  }
  static void expectColor(const Frame& frame, int x, int y, const vec3& expected, float within = 1e-3f) {
    const char* channels[] = {"R", "G", "B"};
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(frame.at(x, y, channels[c]), expected[c], within) << x << " " << y;
  }
};

// Two sheets before a wall whose halves differ.
Scene sheetsBeforeWall() {
  Scene scene;
  scene.sky = blackSky();
  addSheet(scene, -0.5f, glowing(kWhite, 0.4f));
  addSheet(scene, 0, glowing(kBlue, 0.3f));
  addSheet(scene, -1, glowing(kRed), {4, 9, 9}, -4);
  addSheet(scene, -1, glowing(kGreen), {4, 9, 9}, 4);
  addSheet(scene, -3, glowing(kWhite));
  return scene;
}

vec3 throughBoth(const vec3& wall) { return 0.3f * kBlue + 0.7f * (0.4f * kWhite + 0.6f * wall); }

TEST_F(BlendingTest, SheetsBlendInTheOrderOfTheirDistanceOnExactMethods) {
  const Scene scene = sheetsBeforeWall();
  for (const char* method : {"identity", "exact", "bvh", "screen-first"}) {
    SCOPED_TRACE(method);
    const Frame frame = see(scene, {{"trace.method", method}});
    expectColor(frame, 5, 8, throughBoth(kRed));
    expectColor(frame, 18, 8, throughBoth(kGreen));
    // None passes the wall; one more each where a ray meets the diagonal of a sheet, which is in two triangles.
    EXPECT_GE(frame.report.rays[RAY_THROUGH], 2u * kWidth * kHeight);
    EXPECT_LE(frame.report.rays[RAY_THROUGH], 2u * kWidth * kHeight + 3 * kHeight);
  }
  expectColor(see(scene, {{"trace.effect", "whitted"}}), 18, 8, throughBoth(kGreen));
  // Methods that store surfaces do not know their alpha, the screen's does not know what is behind them.
  for (const char* method : {"attributes", "depth-cube", "screen-space"}) {
    SCOPED_TRACE(method);
    const Frame cut = see(scene, {{"trace.method", method}, {"abuffer.resolution", "256"}});
    expectColor(cut, 5, 8, kBlue);
    ASSERT_EQ(cut.report.warnings.size(), 1u);
    EXPECT_NE(cut.report.warnings[0].find("alphaMode BLEND"), std::string::npos);
  }
}

TEST_F(BlendingTest, AMirrorShowsWhatBlendsAsItIs) {
  Scene scene;
  scene.sky = blackSky();
  addSheet(scene, -1, mirrorMaterial());
  addSheet(scene, 3, glowing(kBlue, 0.3f), vec3(20));
  addSheet(scene, 5, glowing(kRed), vec3(20));
  const Frame frame = see(scene);
  for (const auto& [x, y] : {std::pair{12, 8}, {4, 3}}) expectColor(frame, x, y, 0.3f * kBlue + 0.7f * kRed);
  EXPECT_EQ(frame.report.rays[RAY_REFLECTION], static_cast<std::uint64_t>(kWidth * kHeight));
  EXPECT_GE(frame.report.rays[RAY_THROUGH], static_cast<std::uint64_t>(kWidth * kHeight));
}

TEST_F(BlendingTest, AMirrorBehindASheetReflectsAsManyTimesAsItIsAskedTo) {
  Scene scene;
  scene.sky = blackSky();
  addSheet(scene, 0, glowing(kBlue, 0.25f));
  addSheet(scene, -1, mirrorMaterial());
  addSheet(scene, 5, glowing(kRed), vec3(30));
  // The mirror shows the sheet's other side, and the wall through it.
  const vec3 mirrored = 0.25f * kBlue + 0.75f * kRed;
  expectColor(see(scene), 12, 8, 0.25f * kBlue + 0.75f * mirrored);
}

// What is traced of a pixel that blends lies behind it: the layers of the contract speak of reflections alone.
TEST_F(BlendingTest, PixelsThatBlendAreNotSelected) {
  Scene scene;
  scene.sky = blackSky();
  addSheet(scene, 0, glowing(kBlue, 0.3f), {9, 9, 9}, -9);
  addSheet(scene, -1, mirrorMaterial());
  addSheet(scene, 5, glowing(kRed), vec3(30));
  const Frame frame = see(scene);
  const std::vector<float> selected = frame.plane("selected.Y"), t = frame.plane("hit.T"),
                           reflectivity = frame.plane("reflectivity.Y");
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < selected.size(); ++i) {
    count += selected[i] > 0;
    EXPECT_EQ(t[i] == -2, selected[i] == 0);
    EXPECT_EQ(reflectivity[i] > 0, selected[i] > 0);
  }
  EXPECT_EQ(count, frame.report.selected);
  EXPECT_EQ(count, static_cast<std::uint64_t>(kWidth * kHeight / 2));
  expectColor(frame, 18, 8, kRed);
  const vec3 mirrored = 0.3f * kBlue + 0.7f * kRed;
  expectColor(frame, 3, 8, 0.3f * kBlue + 0.7f * mirrored);
  // A share of the pixels is one of reflections.
  const Frame few = see(scene, {{"select.fraction", "0.1"}, {"trace.bounces", "2"}});
  expectColor(few, 3, 8, 0.3f * kBlue + 0.7f * mirrored);
  EXPECT_LT(few.report.selected, 40u);
}

TEST_F(BlendingTest, WhatLiesOnAWallDoesNotShowWhatIsBehindTheWall) {
  Scene scene;
  scene.sky = blackSky();
  addSheet(scene, 2e-5f, glowing(kBlue, 0.5f));
  addSheet(scene, 0, glowing(kRed));
  addSheet(scene, -1, glowing(kGreen));
  const Frame frame = see(scene);
  for (const auto& [x, y] : {std::pair{12, 8}, {4, 3}}) expectColor(frame, x, y, 0.5f * (kBlue + kRed));
}

TEST_F(BlendingTest, BehindManySheetsOneIsOpaque) {
  Scene scene;
  scene.sky = evenSky(kGreen);
  for (int i = 0; i < 12; ++i) addSheet(scene, -0.1f * static_cast<float>(i), glowing(kBlue, 0.5f));
  // No more of the sky than would come through all.
  expectColor(see(scene), 12, 8, kBlue, 1e-3f);
}

TEST_F(BlendingTest, OfOpaqueOnesNothingIsTraced) {
  Scene scene = soup(100);
  scene.materials[1].alphaMode = AlphaMode::blend;
  const Frame frame = draw(scene, kAbove, settingsWith({}), 64, 48);
  EXPECT_EQ(frame.report.rays[RAY_THROUGH], 0u);
  scene.materials[1].alphaMode = AlphaMode::opaque;
  EXPECT_EQ(draw(scene, kAbove, settingsWith({}), 64, 48).plane("G"), frame.plane("G"));
}

TEST_F(BlendingTest, WithoutRaysTheyAreCutAtAHalf) {
  Scene scene;
  addSheet(scene, 0, glowing(kBlue, 0.3f));
  addSheet(scene, -1, glowing(kRed));
  for (const char* setting : {"select.mode", "trace.method"}) {
    const Frame frame = see(scene, {{setting, "none"}});
    expectColor(frame, 12, 8, kBlue);  // the factor has no say
    ASSERT_EQ(frame.report.warnings.size(), 1u);
    EXPECT_NE(frame.report.warnings[0].find("alphaMode BLEND"), std::string::npos);
  }
  EXPECT_TRUE(see(scene).report.warnings.empty());
}

TEST_F(BlendingTest, RaysToLightsPassWhatTheyLeave) {
  Scene scene;
  scene.sky = blackSky();
  addSheet(scene, 0, diffuse(kWhite));
  Material veil = diffuse(kWhite);
  veil.baseColor.a = 0.25f;
  veil.alphaMode = AlphaMode::blend;
  veil.doubleSided = true;
  addQuad(scene, {0, 3, 3}, {9, 0, 0}, {0, 3, -3}, addMaterial(scene, veil));
  scene.lights = {sun({0, -1, -1}, 1)};
  const Frame veiled = see(scene, {{"shadow.method", "rays"}});
  scene.triangles.resize(2);
  const Frame bare = see(scene, {{"shadow.method", "rays"}});
  EXPECT_GT(bare.at(12, 8, "G"), 0.1f);
  EXPECT_NEAR(veiled.at(12, 8, "G"), 0.75f * bare.at(12, 8, "G"), 1e-4f);
}

// The mean of a plane of a picture.
double meanOf(const Frame& frame, const char* channel) {
  const std::vector<float> values = frame.plane(channel);
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// A floor, a black veil over all of it that covers a quarter, and a lamp over both.
enum class Over { nothing, veil };
Scene veiledFloor(const Material& floor, Over over, bool lamp) {
  Scene scene;
  scene.sky = lamp ? blackSky() : evenSky(kWhite);
  addQuad(scene, {0, 0, 0}, {0, 0, 400}, {400, 0, 0}, addMaterial(scene, floor));
  Material veil = diffuse({0, 0, 0});
  veil.specular = 0;
  veil.baseColor.a = 0.25f;
  veil.alphaMode = AlphaMode::blend;
  veil.doubleSided = true;
  const std::uint32_t material = addMaterial(scene, veil);
  if (over == Over::veil) addQuad(scene, {0, 0.5f, 0}, {400, 0, 0}, {0, 0, 400}, material);
  if (!lamp) return scene;
  Material light = diffuse({0, 0, 0});
  light.specular = 0;
  light.emissive = vec3(4);
  light.doubleSided = true;
  addQuad(scene, {0, 2, 0}, {2, 0, 0}, {0, 0, 2}, addMaterial(scene, light));
  return scene;
}

TEST_F(BlendingTest, PathsMeetSheetsInTheirOrder) {
  const Frame frame =
      see(sheetsBeforeWall(), {{"trace.effect", "path"}, {"effect.samples", "64"}, {"effect.passes", "16"}});
  vec3 left(0), right(0);
  const char* channels[] = {"R", "G", "B"};
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (int c = 0; c < 3; ++c)
        (x < kWidth / 2 ? left : right)[c] += frame.at(x, y, channels[c]) * 2 / (kWidth * kHeight);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(left[c], throughBoth(kRed)[c], 3e-3f);
    EXPECT_NEAR(right[c], throughBoth(kGreen)[c], 3e-3f);
  }
  EXPECT_GT(frame.report.rays[RAY_THROUGH], 1000u * kWidth * kHeight / 2);
}

// Rays to lights and paths that find them are weighted against each other, also behind a surface that blends.
TEST_F(BlendingTest, PathsBringWhatAVeilLeavesOfLampsAndSkies) {
  Material matte = diffuse(vec3(0.8f)), metal = diffuse(kWhite);
  matte.specular = 0;
  metal.metallic = 1;
  const Camera below = lookAt({0, 0.3f, 1}, {0, 0, 0});
  for (const bool lamp : {false, true})
    for (const float roughness : {0.1f, 0.4f, 1.0f}) {
      metal.roughness = roughness;
      for (const Material& floor : {matte, metal}) {
        if (lamp && roughness < 0.2f) continue;  // lamps behind veils are noise in what is all but a mirror
        SCOPED_TRACE(std::to_string(lamp) + " " + std::to_string(roughness) + " " + std::to_string(floor.metallic));
        const Settings settings = settingsWith(
            {{"trace.effect", "path"}, {"effect.samples", "64"}, {"effect.passes", "8"}, {"trace.bounces", "1"}});
        const auto light = [&](Over over) {
          return meanOf(draw(veiledFloor(floor, over, lamp), below, settings, kWidth, kHeight), "G");
        };
        const double bare = light(Over::nothing), veiled = light(Over::veil);
        EXPECT_GT(bare, 0.05);
        EXPECT_NEAR(veiled, 0.75 * bare, 0.01 * bare);
      }
    }
}

TEST_F(BlendingTest, PathsEndAfterAsManyBouncesAsWithoutWhatBlends) {
  // A furnace whose walls shine and reflect a half, with a pane in it that is all but clear.
  Scene scene;
  scene.sky = blackSky();
  Material wall = diffuse(vec3(0.5f));
  wall.specular = 0;
  wall.emissive = vec3(1);
  wall.doubleSided = true;
  const std::uint32_t material = addMaterial(scene, wall);
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      vec3 center(0), u(0), v(0);
      center[axis] = side;
      u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1;
      addQuad(scene, center, u, v, material);
    }
  Material pane = glowing({0, 0, 0}, 0.002f);
  addSheet(scene, 0.1f, pane, vec3(0.9f));
  const Frame frame =
      draw(scene, lookAt({0.2f, 0.1f, 0.7f}, {0, 0, 0}),
           settingsWith(
               {{"trace.effect", "path"}, {"effect.samples", "64"}, {"effect.passes", "2"}, {"trace.bounces", "2"}}),
           kWidth, kHeight);
  EXPECT_NEAR(meanOf(frame, "R"), 1.875, 0.015 * 1.875);
}

TEST_F(BlendingTest, VeilsHideAsMuchOfTheSkyAsTheyCover) {
  Scene scene = veiledFloor(diffuse(kWhite), Over::veil, false);
  const auto light = [&](const Camera& camera) {
    return meanOf(draw(scene, camera,
                       settingsWith({{"trace.effect", "occlusion"}, {"effect.samples", "64"}, {"effect.passes", "4"}}),
                       kWidth, kHeight),
                  "G");
  };
  EXPECT_NEAR(light(lookAt({0, 0.3f, 1}, {0, 0, 0})), 0.75, 1e-3);
  // From above, a quarter of what is seen is the veil's open side.
  EXPECT_NEAR(light(lookAt({0, 2, 1}, {0, 0, 0})), 0.25 + 0.75 * 0.75, 0.01);
  scene.materials[1].alphaMode = AlphaMode::opaque;
  EXPECT_EQ(light(lookAt({0, 0.3f, 1}, {0, 0, 0})), 0);
}

TEST_F(BlendingTest, ThePictureIsThatOfTheLayersEffect) {
  Scene scene = soup(300);
  scene.materials[1].alphaMode = AlphaMode::blend;
  scene.materials[1].baseColor.a = 0.4f;
  for (const char* glossy : {"false", "true"}) {
    SCOPED_TRACE(glossy);
    const Frame found = draw(scene, kAbove, settingsWith({{"effect.glossy", glossy}, {"effect.samples", "2"}}), 64, 48);
    const Frame layers =
        draw(scene, kAbove,
             settingsWith({{"trace.effect", "layers"}, {"select.mode", "all"}, {"effect.transfer", "blend"}}), 64, 48);
    const std::vector<float> a = found.plane("G"), b = layers.plane("G");
    std::size_t unlike = 0;
    for (std::size_t i = 0; i < a.size(); ++i) unlike += std::abs(a[i] - b[i]) > 2e-3f * std::max(b[i], 0.1f);
    EXPECT_LE(unlike, a.size() / 100);
    EXPECT_GT(found.report.rays[RAY_THROUGH], 200u);
    EXPECT_EQ(found.report.overflow, 0u);
  }
}

TEST_F(BlendingTest, NoRayBehindASurfaceIsWrong) {
  Scene scene = soup(300);
  scene.materials[1].alphaMode = AlphaMode::blend;
  scene.materials[1].baseColor.a = 0.4f;
  *counts_ = {};
  Settings settings = settingsWith({});
  settings.trace.method = "witnessed";
  draw(scene, kAbove, settings, 96, 72);
  const Witness& seen = (*counts_)[RAY_THROUGH];
  EXPECT_GT(seen.rays, 200u);
  EXPECT_GT(seen.hits, 20u);
  EXPECT_EQ(seen.wrong(), 0u);
  const Frame own = draw(scene, kAbove, settingsWith({}), 96, 72),
              exact = draw(scene, kAbove, settingsWith({{"trace.method", "exact"}}), 96, 72);
  const std::vector<float> a = own.plane("R"), b = exact.plane("R");
  float worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
  EXPECT_LT(worst, 1e-6f);
}

}  // namespace
}  // namespace halfsilver::testing
