// Ambient occlusion, and what every effect of several passes owes.
#include <algorithm>
#include <cmath>
#include <memory>

#include <halfsilver/builtin.h>
#include "builtin/mesh_builder.h"
#include "gpu/ray_witness.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

using glm::vec3;

class OcclusionEffectTest : public WitnessTest {
 protected:
  static Settings settings(std::initializer_list<std::pair<const char*, const char*>> more = {}) {
    Settings result = settingsWith({{"trace.effect", "occlusion"}});
    for (const auto& [name, value] : more) set(result, name, value);
    return result;
  }
};

constexpr double kHeight = 1.5, kRadius = 0.7;

// A ball whose center is `kHeight` above a floor.
Scene ballOverFloor() {
  MeshBuilder build;
  build.rectangle({-40, 0, -40}, {80, 0, 0}, {0, 0, 80});
  build.lathe(Profile().arc({0, 0}, kRadius, 0.5 * kPi, -0.5 * kPi, 60), {0, kHeight, 0}, 120);
  Scene scene;
  scene.materials.push_back(plain(vec3(0.8f)));
  scene.vertices = build.mesh().vertices;
  scene.triangles = build.mesh().triangles;
  return scene;
}

TEST_F(OcclusionEffectTest, OfAFloorUnderABallIsItsFormFactor) {
  const Scene scene = ballOverFloor();
  const Camera camera = lookAt({0, 0.6f, 4}, {0, 0.1f, 0});
  const int width = 96, height = 64;
  const Frame frame = draw(scene, camera, settings({{"effect.samples", "64"}, {"effect.passes", "8"}}), width, height);
  double squares = 0, sum = 0, darkest = 1;
  std::size_t pixels = 0;
  const vec3 forward = glm::normalize(camera.target - camera.eye),
             right = glm::normalize(glm::cross(forward, {0, 1, 0}));
  const vec3 up = glm::cross(right, forward);
  const float tangent = std::tan(0.5f * camera.verticalFov);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (frame.at(x, y, "normal.Y") < 0.999f || frame.at(x, y, "depth.Z") <= 0) continue;
      const float sx = (2 * static_cast<float>(x) + 1 - width) / width * tangent * width / height;
      const float sy = (height - 2 * static_cast<float>(y) - 1) / height * tangent;
      const vec3 point = camera.eye + frame.at(x, y, "depth.Z") * (forward + sx * right + sy * up);
      if (std::abs(point.y) > 1e-3f) continue;  // the top of the ball
      const double distance = std::sqrt(kHeight * kHeight + static_cast<double>(point.x * point.x + point.z * point.z));
      const double seen = 1 - kRadius * kRadius * kHeight / (distance * distance * distance);
      const double error = static_cast<double>(frame.at(x, y, "reflection.R")) - seen;
      squares += error * error;
      sum += error;
      darkest = std::min(darkest, seen);
      ++pixels;
    }
  ASSERT_GT(pixels, 1500u);
  EXPECT_LT(darkest, 0.85);
  const auto count = static_cast<double>(pixels);
  EXPECT_LT(std::sqrt(squares / count), 0.01);
  EXPECT_LT(std::abs(sum / count), 0.001);
  EXPECT_EQ(frame.report.overflow, 0u);
  EXPECT_EQ(frame.report.rays[RAY_OCCLUSION], frame.report.selected * 64 * 8);
}

TEST_F(OcclusionEffectTest, NothingHidesAConvexMeshFromItself) {
  Scene scene = ballOverFloor();
  scene.triangles.erase(scene.triangles.begin(), scene.triangles.begin() + 2);  // the floor
  const Frame frame = draw(scene, lookAt({0, 2, 3}, {0, 1.5f, 0}), settings({{"effect.samples", "16"}}), 64, 48);
  std::size_t surface = 0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      if (frame.at(x, y, "selected.Y") == 0) continue;
      ++surface;
      EXPECT_EQ(frame.at(x, y, "R"), 1.0f) << x << " " << y;
    }
  EXPECT_GT(surface, 300u);
}

TEST_F(OcclusionEffectTest, ThingsBeyondTheRadiusDoNotCount) {
  const Scene scene = ballOverFloor();
  const Camera camera = lookAt({0, 0.6f, 4}, {0, 0.1f, 0});
  const auto hidden = [&](const char* radius) {
    const Frame frame = draw(scene, camera, settings({{"effect.radius", radius}}), 64, 48);
    const std::vector<float> seen = frame.plane("R"), selected = frame.plane("selected.Y");
    int count = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) count += selected[i] != 0 && seen[i] < 1;
    return count;
  };
  EXPECT_EQ(hidden("0.5"), 0);  // the ball begins 0.8 m above
  EXPECT_GT(hidden("3"), 100);
}

TEST_F(OcclusionEffectTest, PicturesAreTheSameHoweverTheirRaysComeInPassesAndFrames) {
  const Scene scene = soup(200);
  const auto one = [&](const char* samples, const char* passes) {
    return draw(scene, kAbove, settings({{"effect.samples", samples}, {"effect.passes", passes}}), 64, 48);
  };
  const Frame some = one("4", "16"), many = one("64", "1"), few = one("4", "4");
  EXPECT_EQ(some.plane("R"), many.plane("R"));
  EXPECT_NE(some.plane("R"), few.plane("R"));

  Renderer renderer = makeRenderer(scene);
  const Settings progressive = settings({{"effect.samples", "4"}, {"effect.progressive", "true"}});
  Frame last;
  for (int frame = 0; frame < 4; ++frame) last = drawWith(renderer, kAbove, progressive, 64, 48);
  EXPECT_EQ(last.report.passes, 4u);
  EXPECT_EQ(last.plane("R"), few.plane("R"));
  // A change begins another picture, and only a change does.
  Camera moved = kAbove;
  moved.eye.x += 0.01f;
  EXPECT_EQ(drawWith(renderer, moved, progressive, 64, 48).report.passes, 1u);
  EXPECT_EQ(drawWith(renderer, moved, progressive, 64, 48).report.passes, 2u);
  renderer.update(scene, {.materials = true});
  EXPECT_EQ(drawWith(renderer, moved, progressive, 64, 48).report.passes, 1u);
}

TEST_F(OcclusionEffectTest, NoRayOfTheDefaultMethodIsWrong) {
  for (const char* name : {"soup", "sphere", "teapot"}) {
    SCOPED_TRACE(name);
    const bool made = std::string(name) == "soup";
    const Scene scene = made ? soup(600) : makeBuiltin(name).scene;
    const Camera camera = made ? kAbove : scene.cameras.front();
    *counts_ = {};
    Settings wanted = settings({{"effect.samples", "4"}});
    wanted.trace.method = "witnessed";
    draw(scene, camera, wanted, 64, 48);
    const Witness& occlusion = (*counts_)[RAY_OCCLUSION];
    EXPECT_GT(occlusion.rays, 3000u);
    EXPECT_GT(occlusion.hits, occlusion.rays / 20);
    EXPECT_EQ(occlusion.wrong(), 0u);
  }
}

TEST_F(OcclusionEffectTest, PicturesOverTheDefaultAndOverExactRaysAreEqual) {
  const Scene scene = soup(400);
  const Frame exact = draw(scene, kAbove, settings({{"trace.method", "exact"}}), 80, 60);
  const Frame bands = draw(scene, kAbove, settings(), 80, 60);
  EXPECT_EQ(exact.plane("R"), bands.plane("R"));
  const std::vector<float> seen = bands.plane("R");
  EXPECT_GT(std::count_if(seen.begin(), seen.end(), [](float value) { return value > 0.1f && value < 0.9f; }), 500);
}

}  // namespace
}  // namespace halfsilver::testing
