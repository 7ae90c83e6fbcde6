// Rays through all layers: closed forms of what sheets add up to.
#include <algorithm>
#include <cmath>
#include <memory>

#include <halfsilver/builtin.h>
#include "builtin/mesh_builder.h"
#include "gpu/ray_witness.h"
#include "gpu/shader_function.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

using glm::vec3;

class LayersTest : public WitnessTest {
 protected:
  static Settings settings(std::initializer_list<std::pair<const char*, const char*>> more = {}) {
    Settings result = settingsWith({{"trace.effect", "layers"}, {"select.mode", "all"}});
    for (const auto& [name, value] : more) set(result, name, value);
    return result;
  }
};

Material glowing(const glm::vec4& color) {
  Material material = plain(vec3(color));
  material.baseColor = color;
  material.unlit = true;
  material.doubleSided = true;
  return material;
}

Sky evenly(const vec3& radiance) {
  Sky sky;
  sky.zenith = sky.horizon = sky.ground = radiance;
  return sky;
}

// Sheets across the z axis, the first nearest to kAlongZ, each 0.5 m behind the last and of a material of its own.
Scene sheets(const std::vector<Material>& materials, const std::vector<std::uint32_t>& order) {
  Scene scene;
  scene.materials = materials;
  for (const std::uint32_t sheet : order) {
    const float z = -0.5f * static_cast<float>(sheet);
    addQuad(scene, {-9, -9, z}, {9, -9, z}, {9, 9, z}, {-9, 9, z}, sheet);
  }
  scene.sky = evenly(vec3(0.25f, 0.5f, 1));
  return scene;
}
const Camera kAlongZ = lookAt({0, 0, 2}, {0, 0, 0});

vec3 colorAt(const Frame& frame, int x, int y) {
  return {frame.at(x, y, "R"), frame.at(x, y, "G"), frame.at(x, y, "B")};
}

void expectColor(const Frame& frame, int x, int y, const vec3& expected, float within) {
  const vec3 color = colorAt(frame, x, y);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(color[c], expected[c], within) << x << " " << y << " channel " << c;
}

// Cosine between a pixel's ray and the z axis.
float cosineOf(int x, int y, int width, int height) {
  const float tangent = std::tan(0.5f * kAlongZ.verticalFov);
  const float sx = (2 * static_cast<float>(x) + 1 - static_cast<float>(width)) / static_cast<float>(height) * tangent;
  const float sy = (static_cast<float>(height) - 2 * static_cast<float>(y) - 1) / static_cast<float>(height) * tangent;
  return 1 / std::sqrt(1 + sx * sx + sy * sy);
}

TEST_F(LayersTest, ManyEqualSheetsLetThroughAPowerOfWhatOneDoes) {
  for (const int count : {1, 3, 12}) {
    SCOPED_TRACE(count);
    std::vector<std::uint32_t> order(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(i);
    const Scene scene = sheets(std::vector<Material>(order.size(), glowing({0.9f, 0.6f, 0.3f, 1})), order);
    const Frame frame =
        draw(scene, kAlongZ, settings({{"effect.transfer", "surface"}, {"effect.opacity", "0.2"}}), 24, 16);
    const auto passes = static_cast<float>(std::pow(0.8, count));
    const vec3 expected = passes * vec3(0.25f, 0.5f, 1) + (1 - passes) * vec3(0.9f, 0.6f, 0.3f);
    for (const auto& [x, y] : {std::pair{12, 8}, {3, 2}, {20, 13}}) expectColor(frame, x, y, expected, 2e-6f);
    EXPECT_EQ(frame.report.rays[RAY_THROUGH], static_cast<std::uint64_t>(count) * 24 * 16);
    EXPECT_EQ(frame.report.overflow, 0u);
  }
}

TEST_F(LayersTest, SkinsOfAnXRayAreThickerAtASlant) {
  const Scene scene = sheets(std::vector<Material>(4, glowing({1, 1, 1, 1})), {0, 1, 2, 3});
  const Frame frame = draw(scene, kAlongZ, settings({{"effect.opacity", "0.2"}}), 48, 32);
  float darkest = 1, brightest = 0;
  for (int y = 0; y < 32; y += 3)
    for (int x = 0; x < 48; x += 3) {
      const float passes = std::pow(0.8f, 4 / cosineOf(x, y, 48, 32));
      expectColor(frame, x, y, passes * vec3(0.25f, 0.5f, 1) + (1 - passes) * vec3(0.62f, 0.78f, 1), 1e-5f);
      darkest = std::min(darkest, passes);
      brightest = std::max(brightest, passes);
    }
  EXPECT_GT(brightest, darkest + 0.05f);
}

TEST_F(LayersTest, AnXRayOfABallIsDensestAtItsOutline) {
  MeshBuilder build;
  build.lathe(Profile().arc({0, 0}, 1, 0.5 * kPi, -0.5 * kPi, 180), {0, 0, 0}, 360);
  Scene scene;
  scene.materials = {plain(vec3(0.5f))};
  scene.materials.front().doubleSided = true;
  scene.vertices = build.mesh().vertices;
  scene.triangles = build.mesh().triangles;
  scene.sky = evenly(vec3(0));
  const int size = 64;
  const Frame frame = draw(scene, lookAt({0, 0, 4}, {0, 0, 0}), settings({{"effect.opacity", "0.1"}}), size, size);
  int surface = 0;
  float center = 1, outline = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      if (frame.at(x, y, "selected.Y") == 0) {
        EXPECT_EQ(frame.at(x, y, "R"), 0.0f);
        continue;
      }
      const vec3 normal(frame.at(x, y, "normal.X"), frame.at(x, y, "normal.Y"), frame.at(x, y, "normal.Z"));
      const vec3 point = normal;  // of a ball of radius 1
      const float cosine = -glm::dot(normal, glm::normalize(point - vec3(0, 0, 4)));
      if (cosine < 0.15f) continue;                        // facets are seen, not the ball
      const float dense = 1 - std::pow(0.9f, 2 / cosine);  // in and out
      EXPECT_NEAR(frame.at(x, y, "R"), 0.62f * dense, 0.02f * dense) << x << " " << y;
      center = std::min(center, dense);
      outline = std::max(outline, dense);
      ++surface;
    }
  EXPECT_GT(surface, 600);
  EXPECT_GT(outline, 2 * center);
  EXPECT_GE(frame.report.rays[RAY_THROUGH], 2 * frame.report.selected);  // to the far side, and on
}

TEST_F(LayersTest, LayersBeyondTheCountAreNotLookedAt) {
  const std::vector<Material> materials = {glowing({1, 0, 0, 1}), glowing({0, 1, 0, 1}), glowing({0, 0, 1, 1})};
  Scene scene = sheets(materials, {0, 1, 2});
  scene.sky = evenly(vec3(0));
  const auto with = [&](const char* count) {
    return draw(scene, kAlongZ,
                settings({{"effect.transfer", "surface"}, {"effect.opacity", "0.5"}, {"effect.layers", count}}), 24,
                16);
  };
  const Frame one = with("1"), two = with("2"), three = with("3"), many = with("64");
  expectColor(one, 12, 8, {0.5f, 0, 0}, 1e-6f);
  expectColor(two, 12, 8, {0.5f, 0.25f, 0}, 1e-6f);
  expectColor(three, 12, 8, {0.5f, 0.25f, 0.125f}, 1e-6f);
  EXPECT_EQ(many.plane("B"), three.plane("B"));
  EXPECT_EQ(one.report.rays[RAY_THROUGH], 0u);
}

TEST_F(LayersTest, SheetsBlendInTheOrderOfTheirDistance) {
  const std::vector<Material> materials = {glowing({1, 0, 0, 1}), glowing({0, 1, 0, 1}), glowing({0, 0, 1, 1})};
  const Settings wanted = settings({{"effect.transfer", "surface"}, {"effect.opacity", "0.5"}});
  const Frame first = draw(sheets(materials, {0, 1, 2}), kAlongZ, wanted, 24, 16);
  const Frame second = draw(sheets(materials, {2, 0, 1}), kAlongZ, wanted, 24, 16);
  for (const char* channel : {"R", "G", "B"}) EXPECT_EQ(first.plane(channel), second.plane(channel));
  expectColor(first, 12, 8, 0.125f * vec3(0.25f, 0.5f, 1) + vec3(0.5f, 0.25f, 0.125f), 1e-6f);
}

TEST_F(LayersTest, ASheetThatBlendsShowsWhatIsBehindIt) {
  std::vector<Material> materials = {glowing({0.2f, 0.2f, 1, 0.3f}), glowing({1, 1, 1, 0.4f}), glowing({1, 0, 0, 1})};
  materials[0].alphaMode = materials[1].alphaMode = AlphaMode::blend;
  Scene scene = sheets(materials, {0, 1});
  // A wall of two halves behind the sheets, and more behind that.
  scene.materials.push_back(glowing({0, 1, 0, 1}));
  addQuad(scene, {-4, -4, -1}, {0, -4, -1}, {0, 4, -1}, {-4, 4, -1}, 2);
  addQuad(scene, {0, -4, -1}, {4, -4, -1}, {4, 4, -1}, {0, 4, -1}, 3);
  addQuad(scene, {-4, -4, -3}, {4, -4, -3}, {4, 4, -3}, {-4, 4, -3}, 2);
  const auto mixed = [](const vec3& wall) {
    return 0.3f * vec3(0.2f, 0.2f, 1) + 0.7f * (0.4f * vec3(1) + 0.6f * wall);
  };
  for (const char* method : {"identity", "exact", "bvh"}) {
    SCOPED_TRACE(method);
    const Frame frame =
        draw(scene, kAlongZ, settings({{"effect.transfer", "blend"}, {"trace.method", method}}), 24, 16);
    expectColor(frame, 5, 8, mixed({1, 0, 0}), 2e-6f);
    expectColor(frame, 18, 8, mixed({0, 1, 0}), 2e-6f);
    EXPECT_EQ(frame.report.rays[RAY_THROUGH], 2u * 24 * 16);  // no ray passes the wall
  }
  // Without the mode the nearest sheet is all that there is.
  scene.materials[0].alphaMode = AlphaMode::opaque;
  expectColor(draw(scene, kAlongZ, settings({{"effect.transfer", "blend"}}), 24, 16), 5, 8, {0.2f, 0.2f, 1}, 1e-6f);
}

TEST_F(LayersTest, ASheetThatIsClearIsNotThere) {
  std::vector<Material> materials = {glowing({1, 1, 1, 0}), glowing({1, 0, 0, 1})};
  materials[0].alphaMode = AlphaMode::blend;
  const Frame frame = draw(sheets(materials, {0, 1}), kAlongZ,
                           settings({{"effect.transfer", "blend"}, {"effect.layers", "1"}}), 24, 16);
  expectColor(frame, 12, 8, {1, 0, 0}, 0);
}

// The G-buffer keeps colors in half floats.
void expectAlike(const std::vector<float>& a, const std::vector<float>& b) {
  std::size_t unlike = 0;
  for (std::size_t i = 0; i < a.size(); ++i) unlike += std::abs(a[i] - b[i]) > 2e-3f * std::max(b[i], 0.1f);
  EXPECT_LE(unlike, a.size() / 500);
  EXPECT_GT(*std::max_element(b.begin(), b.end()), 1.5f * *std::min_element(b.begin(), b.end()));
}

TEST_F(LayersTest, OfOpaqueSurfacesThePictureIsTheDeferredOne) {
  Scene scene = soup(300);
  scene.lights.push_back({});
  const Frame layers = draw(scene, kAbove, settings({{"effect.transfer", "surface"}, {"effect.opacity", "1"}}), 64, 48);
  EXPECT_EQ(layers.report.rays[RAY_THROUGH], 0u);
  expectAlike(layers.plane("G"), draw(scene, kAbove, settingsWith({{"select.mode", "none"}}), 64, 48).plane("G"));
}

TEST_F(LayersTest, WithoutMaterialsThatBlendThePictureIsThatOfReflections) {
  const Scene scene = soup(300);
  for (const char* bounces : {"1", "3"}) {
    SCOPED_TRACE(bounces);
    const Frame layers =
        draw(scene, kAbove, settings({{"effect.transfer", "blend"}, {"trace.bounces", bounces}}), 64, 48);
    const Frame mirrored = draw(scene, kAbove, settingsWith({{"trace.bounces", bounces}}), 64, 48);
    EXPECT_EQ(layers.report.rays[RAY_THROUGH], 0u);
    EXPECT_GT(layers.report.rays[RAY_REFLECTION], layers.report.selected / 2);
    EXPECT_EQ(layers.report.overflow, 0u);
    expectAlike(layers.plane("G"), mirrored.plane("G"));
  }
}

TEST_F(LayersTest, ASheetThatBlendsDoesSoInAMirrorToo) {
  // Seen past the mirror's camera: the mirror at z = -1 shows the sheet at z = 3 and the wall at z = 5.
  std::vector<Material> materials = {mirrorMaterial(), glowing({0.2f, 0.2f, 1, 0.3f}), glowing({1, 0, 0, 1})};
  materials[1].alphaMode = AlphaMode::blend;
  Scene scene;
  scene.materials = materials;
  addQuad(scene, {-9, -9, -1}, {9, -9, -1}, {9, 9, -1}, {-9, 9, -1}, 0);
  addQuad(scene, {-20, -20, 3}, {20, -20, 3}, {20, 20, 3}, {-20, 20, 3}, 1);
  addQuad(scene, {-20, -20, 5}, {20, -20, 5}, {20, 20, 5}, {-20, 20, 5}, 2);
  scene.sky = evenly(vec3(0));
  const Frame frame = draw(scene, kAlongZ, settings({{"effect.transfer", "blend"}}), 24, 16);
  for (const auto& [x, y] : {std::pair{12, 8}, {4, 3}})
    expectColor(frame, x, y, 0.3f * vec3(0.2f, 0.2f, 1) + 0.7f * vec3(1, 0, 0), 2e-6f);
  EXPECT_EQ(frame.report.rays[RAY_REFLECTION], 24u * 16);
  EXPECT_EQ(frame.report.rays[RAY_THROUGH], 24u * 16);
}

TEST_F(LayersTest, PicturesOverTheDefaultAndOverExactRaysAreEqual) {
  Scene scene = soup(400);
  scene.materials[0].doubleSided = true;
  scene.materials[1].alphaMode = AlphaMode::blend;
  scene.materials[1].baseColor.a = 0.4f;
  for (const char* transfer : {"xray", "surface", "blend"}) {
    SCOPED_TRACE(transfer);
    const auto over = [&](const char* method) {
      return draw(scene, kAbove, settings({{"effect.transfer", transfer}, {"trace.method", method}}), 80, 60);
    };
    const Frame exact = over("exact"), own = over("identity");
    for (const char* channel : {"R", "G", "B"}) EXPECT_EQ(exact.plane(channel), own.plane(channel));
    const std::vector<float> red = own.plane("R");
    EXPECT_GT(*std::max_element(red.begin(), red.end()), *std::min_element(red.begin(), red.end()) + 0.1f);
    EXPECT_GT(own.report.rays[RAY_THROUGH], own.report.selected / 10);
  }
}

TEST_F(LayersTest, NoRayOfTheDefaultMethodIsWrong) {
  for (const char* name : {"soup", "sphere"}) {
    SCOPED_TRACE(name);
    const bool made = std::string(name) == "soup";
    const Scene scene = made ? soup(600) : makeBuiltin(name).scene;
    *counts_ = {};
    Settings wanted = settings();
    wanted.trace.method = "witnessed";
    draw(scene, made ? kAbove : scene.cameras.front(), wanted, 96, 72);
    const Witness& through = (*counts_)[RAY_THROUGH];
    EXPECT_GT(through.rays, 3000u);
    EXPECT_GT(through.hits, through.rays / 20);
    EXPECT_EQ(through.wrong(), 0u);
  }
}

// Other settings of the effect make other rays, which may need what no ray has asked for so far.
TEST_F(LayersTest, AFrameDoesNotCountOnTheRaysOfOtherSettings) {
  const Scene scene = soup(300);
  const Settings opaque = settings({{"effect.transfer", "xray"}, {"effect.opacity", "1"}});
  const Settings clear = settings({{"effect.transfer", "xray"}, {"effect.opacity", "0.2"}});
  Renderer renderer = makeRenderer(scene);
  for (int frame = 0; frame < 3; ++frame) drawWith(renderer, kAbove, opaque, 48, 36);
  const Frame after = drawWith(renderer, kAbove, clear, 48, 36);
  EXPECT_EQ(after.report.overflow, 0u);
  EXPECT_GT(after.report.rays[RAY_THROUGH], 500u);
  EXPECT_EQ(after.plane("R"), draw(scene, kAbove, clear, 48, 36).plane("R"));
}

}  // namespace
}  // namespace halfsilver::testing
