// What rays to lights and rays through glass are made of.
#include <cmath>
#include <glm/gtc/constants.hpp>

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
