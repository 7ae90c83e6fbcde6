// Path tracing against what is known: furnaces, form factors, and itself.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include <halfsilver/builtin.h>
#include "builtin/mesh_builder.h"
#include "gpu/ray_witness.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

using glm::vec3;

class PathTest : public WitnessTest {
 protected:
  static Settings settings(std::initializer_list<std::pair<const char*, const char*>> more = {}) {
    Settings result = settingsWith({{"trace.effect", "path"}, {"trace.method", "exact"}});
    for (const auto& [name, value] : more) set(result, name, value);
    return result;
  }
};

Material white() {
  Material material;
  material.metallic = 0;
  material.specular = 0;
  return material;
}

Sky evenly(float radiance) {
  Sky sky;
  sky.zenith = sky.horizon = sky.ground = vec3(radiance);
  return sky;
}

Scene sceneOf(const MeshBuilder& build, std::vector<Material> materials) {
  Scene scene;
  scene.materials = std::move(materials);
  scene.vertices = build.mesh().vertices;
  scene.triangles = build.mesh().triangles;
  scene.sky = evenly(0);
  return scene;
}

// A ball of radius 1 in a sky of radiance 1.
Scene furnace(const Material& material) {
  MeshBuilder build;
  build.lathe(Profile().arc({0, 0}, 1, 0.5 * kPi, -0.5 * kPi, 180), {0, 0, 0}, 360);
  Scene scene = sceneOf(build, {material});
  scene.sky = evenly(1);
  return scene;
}
const Camera kBeforeBall = lookAt({0, 0, 4}, {0, 0, 0});

// Mean light of the ball's pixels, by how far from its center they are seen.
std::vector<double> rings(const Frame& frame) {
  constexpr int kRings = 4;
  std::vector<double> sums(kRings, 0), counts(kRings, 0);
  for (int y = 0; y < frame.layers.height; ++y)
    for (int x = 0; x < frame.layers.width; ++x) {
      if (frame.at(x, y, "selected.Y") == 0) continue;
      const double facing = static_cast<double>(frame.at(x, y, "normal.Z"));
      const auto ring = std::clamp(static_cast<int>((1 - facing * facing) * kRings), 0, kRings - 1);
      sums[static_cast<std::size_t>(ring)] += static_cast<double>(frame.at(x, y, "R"));
      counts[static_cast<std::size_t>(ring)] += 1;
    }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    EXPECT_GE(counts[i], 20);
    sums[i] /= counts[i];
  }
  return sums;
}

struct FurnaceCase {
  const char* name;
  float metallic, roughness, specular, coat, coatRoughness, transmission;
  float sheen = 0, anisotropy = 0;
  double tolerance = 0.01;
};
class Furnace : public PathTest, public ::testing::WithParamInterface<FurnaceCase> {};

TEST_P(Furnace, WhiteInAnEvenLightIsAsBrightAsThat) {
  const FurnaceCase& wanted = GetParam();
  Material material;
  material.metallic = wanted.metallic;
  material.roughness = wanted.roughness;
  material.specular = wanted.specular;
  material.coat = wanted.coat;
  material.coatRoughness = wanted.coatRoughness;
  material.transmission = wanted.transmission;
  material.sheenColor = vec3(wanted.sheen);
  material.sheenRoughness = 0.5f;
  material.anisotropy = wanted.anisotropy;
  if (wanted.transmission > 0) material.thickness = 1;
  material.doubleSided = wanted.transmission > 0;
  const bool glass = wanted.transmission > 0;
  const Frame frame =
      draw(furnace(material), kBeforeBall,
           settings({{"effect.samples", "64"}, {"effect.passes", "4"}, {"trace.bounces", glass ? "16" : "1"}}), 40, 40);
  for (const double mean : rings(frame)) EXPECT_NEAR(mean, 1, wanted.tolerance);
  EXPECT_EQ(frame.report.overflow, 0u);
}

INSTANTIATE_TEST_SUITE_P(
    Materials, Furnace,
    ::testing::Values(
        FurnaceCase{"diffuse", 0, 1, 0, 0, 0, 0}, FurnaceCase{"plastic", 0, 0.4f, 1, 0, 0, 0},
        FurnaceCase{"mirror", 1, 0, 1, 0, 0, 0}, FurnaceCase{"smooth_metal", 1, 0.1f, 1, 0, 0, 0},
        FurnaceCase{"metal", 1, 0.5f, 1, 0, 0, 0}, FurnaceCase{"rough_metal", 1, 1, 1, 0, 0, 0},
        FurnaceCase{"coated", 0, 1, 0, 1, 0, 0}, FurnaceCase{"rough_coat_on_metal", 1, 0.6f, 1, 1, 0.3f, 0},
        // What the fit of the fibers' albedo, and the facets' loss, which is that of one roughness, leave open.
        FurnaceCase{"cloth", 0, 1, 0, 0, 0, 0, 1, 0, 0.02},
        FurnaceCase{"coated_cloth", 0, 1, 0, 1, 0, 0, 0.5f, 0, 0.02},
        FurnaceCase{"brushed_metal", 1, 0.4f, 1, 0, 0, 0, 0, 0.8f, 0.05}, FurnaceCase{"glass", 0, 0, 1, 0, 0, 1}),
    [](const auto& test) { return std::string(test.param.name); });

// Walls that emit 1 and reflect a half: each reflection adds half of the last.
TEST_F(PathTest, InsideAnEmittingBoxLightIsASeries) {
  Material wall = white();
  wall.baseColor = {0.5f, 0.5f, 0.5f, 1};
  wall.emissive = vec3(1);
  wall.doubleSided = true;
  MeshBuilder build;
  build.box({-1, -1, -1}, {1, 1, 1});
  const Scene scene = sceneOf(build, {wall});
  double expected = 1, term = 1;
  for (const char* bounces : {"1", "2", "4"}) {
    const int stretches = std::atoi(bounces) + 1;
    expected = term = 1;
    for (int i = 0; i < stretches; ++i) expected += term *= 0.5;
    const Frame frame =
        draw(scene, lookAt({0.2f, 0.1f, 0.7f}, {0, 0, 0}),
             settings({{"effect.samples", "64"}, {"effect.passes", "2"}, {"trace.bounces", bounces}}), 24, 16);
    const std::vector<float> light = frame.plane("R");
    const double mean = std::accumulate(light.begin(), light.end(), 0.0) / static_cast<double>(light.size());
    EXPECT_NEAR(mean, expected, 0.005 * expected) << bounces;
  }
}

// Share of the light of a rectangle that reaches a point below its corner, at a distance of 1 (the form factor).
double cornerFactor(double a, double b) {
  const double p = std::sqrt(1 + a * a), q = std::sqrt(1 + b * b);
  return (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2 * kPi);
}

TEST_F(PathTest, AnEmittingRectangleLightsAFloorByItsFormFactor) {
  Material lamp = white();
  lamp.baseColor = {0, 0, 0, 1};
  lamp.emissive = vec3(3);
  MeshBuilder build;
  build.use(0).rectangle({-6, 0, -6}, {12, 0, 0}, {0, 0, 12});
  build.use(1).rectangle({-0.5, 1, 0.4}, {1, 0, 0}, {0, 0, -0.8});  // shines down
  const Scene scene = sceneOf(build, {white(), lamp});
  const Camera camera = lookAt({0, 0.5f, 2.5f}, {0, 0, 0});
  const int width = 32, height = 24;
  const Frame frame =
      draw(scene, camera, settings({{"effect.samples", "64"}, {"effect.passes", "4"}, {"trace.bounces", "1"}}), width,
           height);
  const vec3 forward = glm::normalize(camera.target - camera.eye),
             right = glm::normalize(glm::cross(forward, {0, 1, 0}));
  const vec3 up = glm::cross(right, forward);
  const float tangent = std::tan(0.5f * camera.verticalFov);
  double squares = 0, brightest = 0;
  int pixels = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float sx = (2 * static_cast<float>(x) + 1 - width) / height * tangent;
      const float sy = (height - 2 * static_cast<float>(y) - 1) / height * tangent;
      const vec3 point = camera.eye + frame.at(x, y, "depth.Z") * (forward + sx * right + sy * up);
      if (frame.at(x, y, "hit.id") < 0 || frame.at(x, y, "hit.id") > 1 || std::abs(point.x) > 3) continue;
      double factor = 0;
      for (const double sideX : {-1.0, 1.0})
        for (const double sideZ : {-1.0, 1.0}) {
          const double a = 0.5 - sideX * static_cast<double>(point.x), b = 0.4 - sideZ * static_cast<double>(point.z);
          factor += std::copysign(1.0, a) * std::copysign(1.0, b) * cornerFactor(std::abs(a), std::abs(b));
        }
      const double error = static_cast<double>(frame.at(x, y, "R")) - 3 * factor;
      squares += error * error;
      brightest = std::max(brightest, 3 * factor);
      ++pixels;
    }
  ASSERT_GT(pixels, 200);
  EXPECT_GT(brightest, 0.5);
  EXPECT_LT(std::sqrt(squares / pixels), 0.01 * brightest);
}

// What Fresnel leaves at 60 degrees, whichever side of the pane faces the camera.
TEST_F(PathTest, AThinPanePassesTheSameFromBothSides) {
  Material pane, lamp = white();
  pane.metallic = pane.roughness = 0;
  pane.transmission = 1;
  pane.doubleSided = true;
  lamp.emissive = vec3(1);
  lamp.baseColor = {0, 0, 0, 1};
  lamp.doubleSided = true;
  for (const double side : {1.0, -1.0}) {
    MeshBuilder build;
    build.use(0).rectangle({-side * 2, 2, 0}, {side * 4, 0, 0}, {0, -4, 0});
    build.use(1).rectangle({-30, 30, -3}, {60, 0, 0}, {0, -60, 0});
    const Camera camera = lookAt({1.7320508f, 0, 1}, {0, 0, 0});
    const Frame frame =
        draw(sceneOf(build, {pane, lamp}), camera, settings({{"effect.samples", "64"}, {"effect.passes", "8"}}), 9, 9);
    EXPECT_LT(frame.at(4, 4, "hit.id"), 2);
    EXPECT_NEAR(frame.at(4, 4, "R"), 1 - 0.0892f, 0.02f) << side;
  }
}

TEST_F(PathTest, TheErrorFallsWithTheRootOfTheSamples) {
  Scene scene = soup(100);
  scene.sky = evenly(0.3f);
  scene.materials.front().emissive = vec3(0.5f, 0.2f, 0.1f);
  const auto light = [&](const char* samples, const char* passes) {
    return draw(scene, kAbove,
                settings({{"effect.samples", samples}, {"effect.passes", passes}, {"trace.bounces", "2"}}), 32, 24)
        .plane("R");
  };
  const std::vector<float> truth = light("64", "64");
  const auto error = [&](const std::vector<float>& picture) {
    double squares = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) squares += std::pow(static_cast<double>(picture[i] - truth[i]), 2);
    return std::sqrt(squares / static_cast<double>(truth.size()));
  };
  const double one = error(light("4", "1")), four = error(light("16", "1")), sixteen = error(light("64", "1"));
  EXPECT_GT(one, 0.01);
  EXPECT_LT(four, 0.65 * one);
  EXPECT_LT(sixteen, 0.65 * four);
}

TEST_F(PathTest, PicturesAreTheSameOverTheDefaultAndInAnyOrderOfPasses) {
  Scene scene = soup(300);
  scene.materials.front().emissive = vec3(0.5f, 0.2f, 0.1f);
  const auto one = [&](const char* method, const char* samples, const char* passes) {
    return draw(
        scene, kAbove,
        settings(
            {{"trace.method", method}, {"effect.samples", samples}, {"effect.passes", passes}, {"trace.bounces", "3"}}),
        48, 32);
  };
  const Frame exact = one("exact", "8", "2"), own = one("identity", "8", "2"), other = one("exact", "2", "8");
  EXPECT_EQ(exact.plane("R"), own.plane("R"));
  EXPECT_EQ(exact.plane("B"), other.plane("B"));
  const std::vector<float> light = own.plane("R");
  EXPECT_GT(*std::max_element(light.begin(), light.end()), 0.3f);
  EXPECT_GT(own.report.rays[RAY_SCATTERED], 4 * own.report.selected);
  EXPECT_GT(own.report.rays[RAY_SHADOW], own.report.selected);
}

TEST_F(PathTest, EndingPathsByChanceChangesNoMean) {
  Scene scene = soup(100);
  scene.sky = evenly(1);
  const auto mean = [&](const char* roulette) {
    const std::vector<float> light = draw(scene, kAbove,
                                          settings({{"effect.samples", "64"},
                                                    {"effect.passes", "4"},
                                                    {"effect.roulette", roulette},
                                                    {"trace.bounces", "6"}}),
                                          32, 24)
                                         .plane("G");
    return std::accumulate(light.begin(), light.end(), 0.0) / static_cast<double>(light.size());
  };
  const double all = mean("false");
  EXPECT_NEAR(mean("true"), all, 0.005 * all);
}

TEST_F(PathTest, NoRayOfTheDefaultMethodIsWrong) {
  for (const char* name : {"soup", "sphere"}) {
    SCOPED_TRACE(name);
    const bool made = std::string(name) == "soup";
    Scene scene = made ? soup(600) : makeBuiltin(name).scene;
    scene.materials.front().emissive = vec3(0.5f);
    *counts_ = {};
    Settings wanted = settings({{"effect.samples", "2"}, {"trace.bounces", "3"}});
    wanted.trace.method = "witnessed";
    draw(scene, made ? kAbove : scene.cameras.front(), wanted, 160, 120);
    for (const std::uint32_t kind : {RAY_SCATTERED, RAY_SHADOW}) {
      const Witness& witness = (*counts_)[kind];
      EXPECT_GT(witness.rays, 3000u);
      EXPECT_GT(witness.hits, witness.rays / 20);
      EXPECT_EQ(witness.wrong(), 0u);
    }
  }
}

}  // namespace
}  // namespace halfsilver::testing
