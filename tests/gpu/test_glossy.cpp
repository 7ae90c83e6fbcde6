// Reflections that rough surfaces spread.
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "gpu/light_fixture.h"
#include "gpu/ray_witness.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

using glm::dvec3;
using glm::vec3;

class GlossyTest : public WitnessTest {
 protected:
  static Settings settings(std::initializer_list<std::pair<const char*, const char*>> more = {}) {
    Settings result = settingsWith({{"effect.glossy", "true"}, {"select.max_roughness", "1"}});
    for (const auto& [name, value] : more) set(result, name, value);
    return result;
  }
};

Scene withRoughness(Scene scene, float roughness) {
  for (Material& material : scene.materials) {
    material.roughness = roughness;
    material.metallic = 1;
    material.mirror.reset();
  }
  return scene;
}

// Mean radiance of a sky that is as bright as it is high, in a white surface (normal y) of the given width of the lobe:
// reflected light over reflectance straight on, by sampling the distribution of normals itself (Walter et al. 2007).
double skyInRoughMetal(double alpha, const dvec3& v) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  double sum = 0;
  constexpr int kSamples = 400000;
  for (int i = 0; i < kSamples; ++i) {
    const double u = unit(random), turn = 6.283185307179586 * unit(random);
    const double tangent2 = alpha * alpha * u / (1 - u), cosine = 1 / std::sqrt(1 + tangent2);
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const dvec3 h(sine * std::cos(turn), cosine, sine * std::sin(turn));
    const double vh = glm::dot(v, h);
    const dvec3 l = 2 * vh * h - v;
    if (vh <= 0 || l.y <= 0) continue;
    const double a2 = alpha * alpha, b = 1 - a2;
    const double shadowing =
        2 * v.y * l.y / (v.y * std::sqrt(a2 + b * l.y * l.y) + l.y * std::sqrt(a2 + b * v.y * v.y));
    sum += l.y * (2 - l.y) * shadowing * vh / (v.y * cosine);
  }
  return sum / kSamples;
}

TEST_F(GlossyTest, RoughMetalShowsTheSkyAsItsFacetsDo) {
  Scene scene;
  Material metal = plain(vec3(1));
  scene.materials.push_back(metal);
  scene = withRoughness(scene, 0.5f);
  addQuad(scene, vec3(0), {50, 0, 0}, {0, 0, -50}, 0);
  // A gradient from nothing at the horizon to 1 straight up.
  scene.sky.horizon = scene.sky.ground = vec3(0);
  scene.sky.zenith = vec3(1);
  const Camera camera = lookAt({0, 2, 2}, {0, 0, 0});
  const Frame frame = draw(scene, camera, settings({{"effect.samples", "64"}}), 33, 33);
  const double expected = skyInRoughMetal(0.25, glm::normalize(dvec3(0, 2, 2)));
  double mean = 0;
  for (int y = 15; y <= 17; ++y)
    for (int x = 15; x <= 17; ++x) mean += static_cast<double>(frame.at(x, y, "reflection.R")) / 9;
  EXPECT_GT(expected, 0.5);
  EXPECT_NEAR(mean, expected, 0.01 * expected);
}

TEST_F(GlossyTest, MirrorsAreTheMirrorsThatTheyWere) {
  const Scene scene = soup(300);  // a mirror below things without reflections
  const Frame mirror = draw(scene, kAbove, settingsWith({{"select.max_roughness", "1"}}), 64, 48);
  const Frame glossy = draw(scene, kAbove, settings({{"effect.samples", "4"}}), 64, 48);
  std::size_t mirrors = 0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      if (mirror.at(x, y, "reflectivity.Y") < 0.9f) continue;
      ++mirrors;
      EXPECT_NEAR(glossy.at(x, y, "R"), mirror.at(x, y, "R"), 1e-6f);
      EXPECT_EQ(glossy.at(x, y, "hit.id"), mirror.at(x, y, "hit.id"));
    }
  EXPECT_GT(mirrors, 300u);
  EXPECT_EQ(glossy.report.selected, mirror.report.selected);
  EXPECT_EQ(glossy.report.rays[RAY_REFLECTION], 4 * mirror.report.rays[RAY_REFLECTION]);
}

TEST_F(GlossyTest, NoRayOfTheDefaultMethodIsWrongAndNoPictureDepartsFromTheExactOne) {
  const Scene scene = withRoughness(soup(300), 0.3f);
  Settings wanted = settings({{"effect.samples", "4"}, {"trace.bounces", "2"}});
  wanted.trace.method = "witnessed";
  const Frame own = draw(scene, kAbove, wanted, 64, 48);
  const Witness& witness = (*counts_)[RAY_REFLECTION];
  EXPECT_GT(witness.rays, 3000u);
  EXPECT_GT(witness.hits, witness.rays / 10);
  EXPECT_EQ(witness.wrong(), 0u);
  wanted.trace.method = "exact";
  const Frame exact = draw(scene, kAbove, wanted, 64, 48);
  const std::vector<float> a = own.plane("R"), b = exact.plane("R");
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-4f);
}

// What is rougher spreads a bright thing wider.
TEST_F(GlossyTest, RougherSurfacesBlurMore) {
  const auto sharpness = [&](float roughness) {
    Scene scene = withRoughness(soup(60), roughness);
    const Frame frame = draw(scene, kAbove, settings({{"effect.samples", "32"}}), 64, 48);
    double steps = 0;
    for (int y = 30; y < 46; ++y)
      for (int x = 1; x < 64; ++x)
        steps += std::abs(static_cast<double>(frame.at(x, y, "reflection.R") - frame.at(x - 1, y, "reflection.R")));
    return steps;
  };
  const double mirror = sharpness(0), satin = sharpness(0.25f), rough = sharpness(0.6f);
  EXPECT_GT(mirror, 1.5 * satin);
  EXPECT_GT(satin, 1.2 * rough);
  EXPECT_GT(rough, 0);
}

}  // namespace
}  // namespace halfsilver::testing
