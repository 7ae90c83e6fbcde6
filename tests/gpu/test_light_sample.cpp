// What rays to lights and rays through glass are made of.
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "gpu/light_fixture.h"
#include "gpu/shader_function.h"

namespace halfsilver::testing {
namespace {

using glm::vec3;
using glm::vec4;

class LightSampleTest : public LightTest {
 protected:
  struct Sample {
    vec3 toLight;
    float distance;
    vec3 light;
  };
  // Of the scene's first light.
  Sample sampleAt(const Light& light, const vec3& position) {
    Scene scene;
    addQuad(scene, {0, -5, 0}, {5, 0, 0}, {0, 0, -5}, addMaterial(scene, diffuse(vec3(1))));
    scene.lights = {light};
    settings.shadow.resolution = 16;
    draw(scene, {}, 2, 2);
    shadows.bind();
    const std::vector<vec4> found = function_.run({vec4(position, 0)});
    return {vec3(found[0]), found[0].w, vec3(found[1])};
  }

 private:
  ShaderFunction function_{api, "lib/light_sample.glsl",
                           "LightSample s = sampleLight(0u, inputs[item].xyz, vec2(0.5));\n"
                           "outputs[2 * item] = vec4(s.toLight, s.distance);\n"
                           "outputs[2 * item + 1] = vec4(s.light, 0.0);",
                           1, 2};
};

TEST_F(LightSampleTest, OfTheSunIsTheSameEverywhere) {
  for (const vec3& position : {vec3(0), vec3(3, 2, -1)}) {
    const Sample sample = sampleAt(sun({3, -4, 0}, 7), position);
    EXPECT_LT(glm::distance(sample.toLight, vec3(-0.6f, 0.8f, 0)), 1e-6f);
    EXPECT_EQ(sample.distance, FAR_AWAY);
    EXPECT_EQ(sample.light, vec3(7));
  }
}

TEST_F(LightSampleTest, OfAPointFallsWithTheSquareOfTheDistanceUpToItsRange) {
  Light light;
  light.type = LightType::point;
  light.position = {0, 2, 0};
  light.color = {1, 0.5f, 0.25f};
  light.intensity = 36;
  const Sample sample = sampleAt(light, {4, -1, 0});
  EXPECT_LT(glm::distance(sample.toLight, vec3(-0.8f, 0.6f, 0)), 1e-6f);
  EXPECT_FLOAT_EQ(sample.distance, 5);
  EXPECT_LT(glm::distance(sample.light, light.color * 36.0f / 25.0f), 1e-5f);
  light.range = 10;
  EXPECT_NEAR(sampleAt(light, {4, -1, 0}).light.r, 36.0f / 25.0f * (1 - 1.0f / 16), 1e-5f);
  light.range = 4.9f;
  EXPECT_EQ(sampleAt(light, {4, -1, 0}).light, vec3(0));
}

TEST_F(LightSampleTest, OfASpotIsDarkOutsideItsCone) {
  Light light;
  light.type = LightType::spot;
  light.position = {0, 2, 0};
  light.intensity = 8;
  light.innerConeAngle = 0.2f;
  light.outerConeAngle = 0.5f;
  EXPECT_FLOAT_EQ(sampleAt(light, {0, 0, 0}).light.r, 2);
  EXPECT_EQ(sampleAt(light, {2 * std::tan(0.51f), 0, 0}).light, vec3(0));
  const float half = std::cos(0.35f), falloff = (half - std::cos(0.5f)) / (std::cos(0.2f) - std::cos(0.5f));
  const float distance = 2 / half;
  EXPECT_NEAR(sampleAt(light, {2 * std::tan(0.35f), 0, 0}).light.r, 8 * falloff * falloff / (distance * distance),
              1e-4f);
}

// Light on a patch that faces y, by as many choices as there are.
class AreaLightTest : public LightSampleTest {
 protected:
  double irradiance(const Light& light, int side) {
    std::vector<vec4> numbers;
    for (int i = 0; i < side; ++i)
      for (int k = 0; k < side; ++k)
        numbers.emplace_back((static_cast<float>(i) + 0.5f) / static_cast<float>(side),
                             (static_cast<float>(k) + 0.5f) / static_cast<float>(side), 0, 0);
    sampleAt(light, vec3(0));  // binds it
    double sum = 0;
    for (const vec4& found : chosen_.run(numbers)) {
      EXPECT_GT(found.y, 0);
      sum += static_cast<double>(found.x);
    }
    return sum / static_cast<double>(numbers.size());
  }

 private:
  ShaderFunction chosen_{api, "lib/light_sample.glsl",
                         "LightSample s = sampleLight(0u, vec3(0.0), inputs[item].xy);\n"
                         "outputs[item] = vec4(s.light.r * max(s.toLight.y, 0.0), s.distance, 0.0, 0.0);",
                         1, 1};
};

TEST_F(AreaLightTest, ChosenPointsOfASphereAddUpToItsClosedForm) {
  Light light;
  light.type = LightType::sphere;
  light.position = {0.6f, 1.2f, 0};
  light.radius = 0.5f;
  light.intensity = 7;
  const double distance2 = 0.36 + 1.44, cosine = 1.2 / std::sqrt(distance2);
  const double expected = 7 * glm::pi<double>() * 0.25 / distance2 * cosine;
  EXPECT_NEAR(irradiance(light, 32), expected, 1e-3 * expected);
  light.position = {0, 0.1f, 0};  // around the patch
  EXPECT_EQ(sampleAt(light, vec3(0)).light, vec3(0));
}

TEST_F(AreaLightTest, ChosenPointsOfARectangleAddUpToItsFormFactor) {
  Light light;
  light.type = LightType::rectangle;
  light.position = {0, 1, 0};
  light.width = 1.5f;
  light.height = 0.8f;
  light.intensity = 7;
  const double a = 0.75, b = 0.4, p = std::sqrt(1 + a * a), q = std::sqrt(1 + b * b);
  // Of four quarters, each with a corner over the patch.
  const double factor = 2 / glm::pi<double>() * (a / p * std::atan(b / p) + b / q * std::atan(a / q));
  EXPECT_NEAR(irradiance(light, 64), 7 * glm::pi<double>() * factor, 1e-3 * 22 * factor);
  light.direction = {0, 1, 0};
  EXPECT_EQ(irradiance(light, 4), 0);
}

class MediaTest : public ContextTest {
 protected:
  // What is on top and below after entering materials (positive: + 1) and leaving them (negative).
  std::pair<int, int> after(const std::vector<int>& steps) const {
    std::vector<vec4> way{vec4(0)};
    for (std::size_t i = 0; i < 4; ++i)
      way[0][static_cast<int>(i)] = i < steps.size() ? static_cast<float>(steps[i]) : 0.0f;
    const vec4 found = function_.run(way)[0];
    return {static_cast<int>(found.x), static_cast<int>(found.y)};
  }

 private:
  ShaderFunction function_{api, "lib/media.glsl",
                           "uint media = 0u;\n"
                           "for (int i = 0; i < 4; ++i) {\n"
                           "  int step = int(inputs[item][i]);\n"
                           "  if (step > 0) media = enterMedium(media, uint(step - 1));\n"
                           "  if (step < 0) media = leaveMedium(media, uint(-step - 1));\n"
                           "}\n"
                           "outputs[item] = vec4(float(media & 0xffffu), float(media >> 16), 0.0, 0.0);",
                           1, 1};
};

TEST_F(MediaTest, TheLastOneEnteredFillsThePlace) {
  using Pair = std::pair<int, int>;
  EXPECT_EQ(after({}), Pair(0, 0));
  EXPECT_EQ(after({5}), Pair(5, 0));
  EXPECT_EQ(after({5, 7}), Pair(7, 5));
  EXPECT_EQ(after({5, 7, -7}), Pair(5, 0)) << "one in the other";
  EXPECT_EQ(after({5, 7, -5}), Pair(7, 0)) << "they overlap";
  EXPECT_EQ(after({5, 7, -5, -7}), Pair(0, 0));
  EXPECT_EQ(after({5, 5, -5}), Pair(5, 0)) << "a mesh that overlaps itself";
  EXPECT_EQ(after({1, 2, 3}), Pair(3, 2)) << "a third displaces the outermost";
  EXPECT_EQ(after({5, -9}), Pair(5, 0)) << "it never entered the other";
}

class InterfaceTest : public ContextTest {
 protected:
  struct Met {
    vec3 refracted;
    float reflectance;
  };
  // By angle of incidence on a plane of normal y, coming from its side.
  Met meet(double angle, float ratio) const {
    const auto sine = static_cast<float>(std::sin(angle)), cosine = static_cast<float>(std::cos(angle));
    const std::vector<vec4> found = function_.run({vec4(sine, -cosine, 0, ratio)});
    return {vec3(found[0]), found[0].w};
  }

 private:
  ShaderFunction function_{api, "lib/dielectric.glsl",
                           "vec4 i = inputs[item];\n"
                           "Interface met = meetInterface(i.xyz, vec3(0.0, 1.0, 0.0), i.w);\n"
                           "outputs[item] = vec4(met.refracted, met.reflectance);",
                           1, 1};
};

// Fresnel's equations in terms of the two angles.
double reflectance(double before, double behind) {
  const double s = std::sin(before - behind) / std::sin(before + behind);
  const double p = std::tan(before - behind) / std::tan(before + behind);
  return 0.5 * (s * s + p * p);
}

TEST_F(InterfaceTest, BendsAndReflectsAsSnellAndFresnelSayBothWays) {
  EXPECT_NEAR(meet(0, 1.5f).reflectance, 0.04, 1e-6);
  for (int degrees = 1; degrees < 89; degrees += 4) {
    const double air = glm::radians(static_cast<double>(degrees)), glass = std::asin(std::sin(air) / 1.5);
    SCOPED_TRACE(degrees);
    const Met in = meet(air, 1 / 1.5f), out = meet(glass, 1.5f);
    EXPECT_NEAR(in.refracted.x, std::sin(glass), 2e-6);
    EXPECT_NEAR(in.refracted.y, -std::cos(glass), 2e-6);
    EXPECT_NEAR(out.refracted.x, std::sin(air), 2e-5);
    EXPECT_NEAR(out.refracted.y, -std::cos(air), 2e-5);
    EXPECT_NEAR(in.reflectance, reflectance(air, glass), 2e-6);
    EXPECT_NEAR(out.reflectance, reflectance(air, glass), 2e-4 * out.reflectance + 2e-6);
  }
}

TEST_F(InterfaceTest, ReflectsAllFromTheCriticalAngleOn) {
  for (const float index : {1.1f, 1.33f, 1.5f, 2.4f}) {
    const double critical = std::asin(1.0 / static_cast<double>(index));
    SCOPED_TRACE(index);
    EXPECT_LT(meet(critical - 1e-3, index).reflectance, 0.9f);
    const Met total = meet(critical + 1e-4, index);
    EXPECT_EQ(total.reflectance, 1);
    EXPECT_NEAR(total.refracted.y, std::cos(critical + 1e-4), 1e-5);
  }
}

TEST_F(InterfaceTest, OfEqualMediaIsNotThere) {
  for (const double angle : {0.0, 0.5, 1.2, 1.5}) {
    const Met met = meet(angle, 1);
    EXPECT_NEAR(met.reflectance, 0, 1e-6);
    EXPECT_NEAR(met.refracted.x, std::sin(angle), 1e-6);
  }
}

}  // namespace
}  // namespace halfsilver::testing
