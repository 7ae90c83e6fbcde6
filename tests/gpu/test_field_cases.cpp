// Scenes from the field: very large and very small ones, bright ones, wide spots and parallel views.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include <halfsilver/io.h>
#include "gpu/posed_models.h"
#include "gpu/render_fixture.h"
#include "shared_scenes.h"

namespace halfsilver::testing {
namespace {

constexpr int kWidth = 320, kHeight = 180;

class FieldCase : public RenderTest {
 protected:
  // A case without light from the sky.
  static Scene dark(const std::string& name) {
    Scene scene = loadGltf(sharedCase(name)).scene;
    scene.sky = {};
    scene.sky.intensity = 0;
    return scene;
  }

  Frame drawCase(const Scene& scene, const Camera& camera, Settings settings = {}, int width = kWidth,
                 int height = kHeight) {
    return draw(scene, camera, settings, width, height);
  }
};

#define HALFSILVER_REQUIRE_CASE(name) HALFSILVER_REQUIRE_SCENE(sharedCase(name))

// Scales the land, which reaches farthest, to a half side.
void stretch(Scene& scene, float size) {
  const Bounds bounds = scene.bounds();
  for (Vertex& vertex : scene.vertices)
    for (const int axis : {0, 2})
      if (vertex.position[axis] == bounds.low[axis] || vertex.position[axis] == bounds.high[axis])
        vertex.position[axis] = std::copysign(size, vertex.position[axis]);
}

TEST_F(FieldCase, WhatIsNearIsSeenHoweverLargeTheSceneIs) {
  HALFSILVER_REQUIRE_CASE("b08_mailbox_in_terrain");
  Scene scene = loadGltf(sharedCase("b08_mailbox_in_terrain")).scene;
  for (const float size : {100.0f, 1e4f, 1e6f}) {
    SCOPED_TRACE(size);
    stretch(scene, size);
    const Frame frame = drawCase(scene, lookAt({0, 1.5f, 0}, {0, 1.5f, -10}));
    EXPECT_EQ(frame.at(kWidth / 2, kHeight / 2, "depth.Z"), 1.0f);
    // A hair's breadth before the eye.
    const Frame close = drawCase(scene, lookAt({0, 1.5f, -0.999f}, {0, 1.5f, -10}));
    EXPECT_NEAR(close.at(kWidth / 2, kHeight / 2, "depth.Z"), 0.001f, 1e-6f);
  }
}

TEST_F(FieldCase, EmissionBeyondHalfFloatsIsTheSameDirectlyAndInAMirror) {
  HALFSILVER_REQUIRE_CASE("b07_emissive_100000");
  Scene scene = dark("b07_emissive_100000");
  for (const float bright : {1e5f, 1234567.0f, 1e4f}) {
    SCOPED_TRACE(bright);
    for (Material& material : scene.materials)
      if (material.emissive.r > 0) material.emissive = glm::vec3(bright);
    const Frame frame = drawCase(scene, scene.cameras.front());
    std::size_t direct = 0, mirrored = 0, wrong = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const float red = frame.at(x, y, "R");
        wrong += red != 0 && red != bright;
        if (frame.at(x, y, "selected.Y") == 1) mirrored += red == bright;
        if (frame.at(x, y, "selected.Y") == 0) direct += red == bright;
      }
    EXPECT_GT(direct, 500u);
    EXPECT_GT(mirrored, 500u);
    EXPECT_EQ(wrong, 0u) << "the mirror is white in every pixel, however its corners' colors are weighted";
  }
}

TEST_F(FieldCase, SpotsOfAHalfSpaceCastTheShadowsOfAPoint) {
  HALFSILVER_REQUIRE_CASE("b06_screen_spot90");
  const Scene spot = dark("b06_screen_spot90"), point = dark("b06_screen_point");
  const Frame bySpot = drawCase(spot, spot.cameras.front(), {}, 480, 270);
  const Frame byPoint = drawCase(point, point.cameras.front(), {}, 480, 270);
  std::size_t shadow = 0, lit = 0, wrong = 0;
  for (int y = 0; y < 270; ++y)
    for (int x = 0; x < 480; ++x) {
      const bool black = byPoint.at(x, y, "R") == 0;
      shadow += black;
      lit += bySpot.at(x, y, "R") > 0;
      wrong += black && bySpot.at(x, y, "R") > 0;
    }
  EXPECT_GT(shadow, 1000u);
  EXPECT_GT(lit, 10000u);
  EXPECT_EQ(wrong, 0u);
}

TEST_F(FieldCase, ACrateOnAnyGroundHasItsShadow) {
  HALFSILVER_REQUIRE_CASE("b09_crate_ground_500");
  Scene scene = dark("b09_crate_ground_500");
  for (const float size : {50.0f, 500.0f, 5000.0f}) {
    SCOPED_TRACE(size);
    stretch(scene, size);
    const Frame frame = drawCase(scene, scene.cameras.front());
    float brightest = 0;
    for (const float red : frame.plane("R")) brightest = std::max(brightest, red);
    std::size_t shadow = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        shadow += frame.at(x, y, "depth.Z") > 5.999f && frame.at(x, y, "R") < 0.25f * brightest;
    EXPECT_EQ(shadow, 2304u);
  }
}

TEST_F(FieldCase, ParallelViewsShowThingsAtTheirSizeAtAnyDistance) {
  HALFSILVER_REQUIRE_CASE("b14_orthographic_first");
  Scene scene = loadGltf(sharedCase("b14_orthographic_first")).scene;
  ASSERT_EQ(scene.cameras.size(), 2u);
  const Camera plan = scene.cameras[0];
  EXPECT_EQ(plan.name, "plan");
  EXPECT_FLOAT_EQ(plan.parallelHeight, 2.25f);
  for (Vertex& vertex : scene.vertices)
    if (vertex.position.x > 1) vertex.position.z -= 5;  // farther away, as large
  const Frame frame = drawCase(scene, plan);
  std::size_t cubes[3] = {};
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const float depth = frame.at(x, y, "depth.Z");
      if (depth <= 0) continue;
      ++cubes[x * 3 / kWidth];
      EXPECT_NEAR(depth, x * 3 / kWidth == 2 ? 7.75f : 2.75f, 1e-6f);
    }
  for (const std::size_t pixels : cubes) EXPECT_EQ(pixels, 1600u);
}

// A mirror that leans back by an eighth of a turn sends all rays of a parallel view up.
TEST_F(FieldCase, RaysOfAParallelViewAreParallelOverAllMethods) {
  HALFSILVER_REQUIRE_CASE("b14_orthographic_first");
  Scene scene = loadGltf(sharedCase("b14_orthographic_first")).scene;
  scene.materials.emplace_back();
  scene.materials.back().mirror = 1.0f;
  const auto mirror = static_cast<std::uint32_t>(scene.materials.size() - 1);
  scene.materials.emplace_back();
  const auto add = [&scene](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d,
                            std::uint32_t material) {
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    for (const glm::vec3& p : {a, b, c, d})
      scene.vertices.push_back({.position = p, .normal = glm::normalize(glm::cross(b - a, c - a))});
    scene.triangles.push_back({{first, first + 1, first + 2}, material});
    scene.triangles.push_back({{first, first + 2, first + 3}, material});
  };
  add({-3, -3, 1}, {3, -3, 1}, {3, 3, -5}, {-3, 3, -5}, mirror);
  add({-9, 8, 9}, {-9, 8, -9}, {9, 8, -9}, {9, 8, 9}, mirror + 1);
  for (const char* method : {"identity", "bvh", "exact"}) {
    if (std::string(method) == "exact" && !HALFSILVER_EXACT) continue;
    SCOPED_TRACE(method);
    const Frame frame = drawCase(scene, scene.cameras[0], settingsWith({{"trace.method", method}}));
    std::size_t hits = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        if (frame.at(x, y, "selected.Y") != 1 || frame.at(x, y, "hit.ny") > -0.5f) continue;
        ++hits;
        const float height = 1.125f * (1 - (2.0f * static_cast<float>(y) + 1) / kHeight);
        EXPECT_NEAR(frame.at(x, y, "hit.T"), 8 - height, 1e-4f);
      }
    EXPECT_GT(hits, 20000u);
  }
}

// What is multiplied: all lengths, and what lights of a place send out by its square.
Scene scaled(Scene scene, float by) {
  for (Vertex& vertex : scene.vertices) vertex.position *= by;
  for (Light& light : scene.lights) {
    light.position *= by;
    light.range *= by;
    if (light.type != LightType::directional) light.intensity *= by * by;
  }
  for (Camera& camera : scene.cameras) {
    camera.eye *= by;
    camera.target *= by;
    camera.nearPlane *= by;
    camera.farPlane *= by;
  }
  return scene;
}

TEST_F(FieldCase, ARoomOfAnySizeIsOnePicture) {
  HALFSILVER_REQUIRE_CASE("c24_lamp");
  Scene room = loadGltf(sharedCase("c24_lamp")).scene;
  room.materials[0].mirror = 0.3f;
  for (Light& light : room.lights) light.intensity = 20;
  const Frame frame = drawCase(room, room.cameras.front());
  for (const int power : {-20, -13, -7, 7, 13, 20}) {  // 1e-6 to 1e6; powers of two round alike
    SCOPED_TRACE(power);
    const Scene other = scaled(room, std::ldexp(1.0f, power));
    const Frame same = drawCase(other, other.cameras.front());
    std::size_t different = 0;
    for (const char* channel : {"R", "G", "B", "reflection.R", "hit.id", "normal.Y"}) {
      const std::vector<float> a = frame.plane(channel), b = same.plane(channel);
      for (std::size_t i = 0; i < a.size(); ++i)
        different += std::abs(a[i] - b[i]) > 1e-3f * std::max(1.0f, std::abs(a[i]));
    }
    EXPECT_LE(different, 4u);
  }
}

}  // namespace
}  // namespace halfsilver::testing
