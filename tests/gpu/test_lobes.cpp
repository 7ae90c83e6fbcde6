// Sheen and stretched highlights against their closed forms: in pixels, in what rays find, and along paths.
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "gpu/light_fixture.h"
#include "gpu/render_fixture.h"
#include "gpu/shader_function.h"

namespace halfsilver::testing {
namespace {

using glm::dvec3;
using glm::vec3;
constexpr double kPi = glm::pi<double>();

// The fibers' distribution (Estevez & Kulla 2017) and visibility (Neubelt & Pettineo 2013), as written there.
double fibers(double nh, double nv, double nl, double roughness) {
  const double alpha = roughness * roughness;
  const double d = (2 + 1 / alpha) * std::pow(std::sqrt(1 - nh * nh), 1 / alpha) / (2 * kPi);
  return d / (4 * (nl + nv - nl * nv));
}

// The share of light that they reflect towards a cosine.
double albedo(double cosine, double roughness) {
  constexpr int kSteps = 200;
  const dvec3 v(std::sqrt(1 - cosine * cosine), 0, cosine);
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double z = (i + 0.5) / kSteps, turn = kPi * (j + 0.5) / kSteps, r = std::sqrt(1 - z * z);
      const dvec3 l(r * std::cos(turn), r * std::sin(turn), z);
      sum += fibers(glm::normalize(v + l).z, cosine, z, roughness) * z;
    }
  return std::min(1.0, 2 * kPi * sum / (kSteps * kSteps));
}

// GGX of two roughnesses, with its Smith term over 4 nl nv; vectors along the tangent, the bitangent and the normal.
double brushed(const dvec3& h, const dvec3& v, const dvec3& l, double alphaX, double alphaY) {
  const double d = h.x * h.x / (alphaX * alphaX) + h.y * h.y / (alphaY * alphaY) + h.z * h.z;
  const auto seen = [&](const dvec3& w) { return std::hypot(alphaX * w.x, alphaY * w.y, w.z); };
  return 0.5 / (l.z * seen(v) + v.z * seen(l)) / (kPi * alphaX * alphaY * d * d);
}

Material cloth(const vec3& base, const vec3& sheen, float roughness) {
  Material material = diffuse(base);
  material.sheenColor = sheen;
  material.sheenRoughness = roughness;
  return material;
}

Material metal(float roughness, float strength, float rotation) {
  Material material;
  material.roughness = roughness;
  material.anisotropy = strength;
  material.anisotropyRotation = rotation;
  return material;
}

Scene plate(const Material& material, const vec3& sunlight, float lux) {
  Scene scene;
  addQuad(scene, {0, 0, 0}, {2, 0, 0}, {0, 0, -2}, addMaterial(scene, material));
  scene.sky = blackSky();
  scene.lights = {sun(sunlight, lux)};
  return scene;
}

// Directions of the plate: x is its tangent, -z its bitangent, y its normal.
dvec3 onPlate(const vec3& direction) {
  const dvec3 unit = glm::normalize(dvec3(direction));
  return {unit.x, -unit.z, unit.y};
}

// Over a base of roughness 1 that reflects at grazing angles alone, as a dielectric without specular color does.
double clothRadiance(const Material& material, int channel, const dvec3& v, const dvec3& l, double lux) {
  const double roughness = static_cast<double>(material.sheenRoughness);
  const double sheen = static_cast<double>(material.sheenColor[channel]);
  const double most =
      static_cast<double>(std::max({material.sheenColor.r, material.sheenColor.g, material.sheenColor.b}));
  const dvec3 h = glm::normalize(v + l);
  const double fresnel = std::pow(1 - glm::dot(v, h), 5);
  const double base =
      static_cast<double>(material.baseColor[channel]) / kPi * (1 - fresnel) + fresnel * brushed(h, v, l, 1, 1);
  const double below = 1 - most * std::max(albedo(v.z, roughness), albedo(l.z, roughness));
  return lux * l.z * (base * below + sheen * fibers(h.z, v.z, l.z, roughness));
}

double metalRadiance(const Material& material, dvec3 v, dvec3 l, double lux) {
  const double alpha = std::pow(static_cast<double>(material.roughness), 2);
  const double along = alpha + (1 - alpha) * std::pow(static_cast<double>(material.anisotropy), 2);
  const double c = std::cos(material.anisotropyRotation), s = std::sin(material.anisotropyRotation);
  for (dvec3* w : {&v, &l}) *w = {c * w->x + s * w->y, c * w->y - s * w->x, w->z};
  return lux * l.z * brushed(glm::normalize(v + l), v, l, along, alpha);
}

class LobesTest : public LightTest {};

const vec3 kEyes[] = {{0, 2, 1}, {2, 1, 0.5f}, {-3, 1, 1}, {0.3f, 1, -3}};
const vec3 kSuns[] = {{0, -1, 0}, {1, -1, 0}, {0.5f, -1, 2}, {-2, -1, -0.5f}};

TEST_F(LobesTest, FibersReflectTheShareThatTheirAlbedoSays) {
  const gl::Define lobes[] = {{"LOBES"}};
  const ShaderFunction function(api, "lib/lobes.glsl",
                                "outputs[item] = vec4(sheenAlbedo(inputs[item].x, inputs[item].y));", 1, 1, lobes);
  std::vector<glm::vec4> inputs;
  for (const float roughness : {0.2f, 0.3f, 0.45f, 0.6f, 0.8f, 1.0f})
    for (const float cosine : {0.05f, 0.15f, 0.3f, 0.5f, 0.7f, 0.9f, 1.0f})
      inputs.emplace_back(cosine, roughness, 0, 0);
  const std::vector<glm::vec4> found = function.run(inputs);
  for (std::size_t i = 0; i < inputs.size(); ++i)
    EXPECT_NEAR(found[i].x, albedo(static_cast<double>(inputs[i].x), static_cast<double>(inputs[i].y)), 0.02)
        << "cosine " << inputs[i].x << " roughness " << inputs[i].y;
}

// White fibers seen at a grazing angle, by the sum over a fine grid of directions.
TEST_F(LobesTest, NoFibersGiveBackMoreThanArrives) {
  const gl::Define lobes[] = {{"LOBES"}};
  const std::string sum =
      "vec4 i = inputs[item]; float sum = 0.0; vec3 v = vec3(sqrt(1.0 - i.x * i.x), 0.0, i.x);"
      "for (int r = 0; r < 128; ++r) for (int s = 0; s < 128; ++s) {"
      "  float z = (float(r) + 0.5) / 128.0, turn = 6.28318530717959 * (float(s) + 0.5) / 128.0, w = sqrt(1.0 - z * z);"
      "  vec3 l = vec3(w * cos(turn), w * sin(turn), z);"
      "  sum += sheenLobe(normalize(v + l).z, i.x, z, i.y) * z; }"
      "outputs[item] = vec4(sum * 6.28318530717959 / (128.0 * 128.0));";
  const ShaderFunction function(api, "lib/lobes.glsl", sum, 1, 1, lobes);
  std::vector<glm::vec4> inputs;
  for (const float roughness : {0.1f, 0.2f, 0.3f, 0.45f})
    for (const float cosine : {0.02f, 0.05f, 0.1f}) inputs.emplace_back(cosine, roughness, 0, 0);
  for (const glm::vec4& found : function.run(inputs)) {
    EXPECT_LE(found.x, 1.02f);
    EXPECT_GT(found.x, 0.5f);
  }
}

TEST_F(LobesTest, ClothUnderTheSun) {
  for (const float roughness : {0.25f, 0.5f, 1.0f})
    for (const vec3& eye : kEyes)
      for (const vec3& direction : kSuns) {
        const Material material = cloth({0.5f, 0.25f, 0}, {0.1f, 0.9f, 0.6f}, roughness);
        const glm::vec4 found = shadeAt(plate(material, direction, 3), eye, {0, 0, 0});
        for (int c = 0; c < 3; ++c) {
          const double expected = clothRadiance(material, c, onPlate(eye), onPlate(-direction), 3);
          // The fit of the albedo, and half floats.
          EXPECT_NEAR(found[c], expected, 0.01 * expected + 3 * 0.5 / kPi * 0.02) << "channel " << c;
        }
      }
}

// Of a base that reflects nothing, the fit of the albedo has no part in the light.
TEST_F(LobesTest, FibersAloneAreTheirClosedForm) {
  const gl::Define lobes[] = {{"LOBES"}};
  const ShaderFunction function(api, "lib/lobes.glsl",
                                "vec4 i = inputs[item]; outputs[item] = vec4(sheenLobe(i.x, i.y, i.z, i.w));", 1, 1,
                                lobes);
  std::vector<glm::vec4> inputs;
  for (const float roughness : {0.2f, 0.5f, 1.0f})
    for (const float nh : {0.3f, 0.7f, 0.95f})
      for (const float nv : {0.1f, 0.6f, 1.0f}) inputs.emplace_back(nh, nv, 0.4f, roughness);
  const std::vector<glm::vec4> found = function.run(inputs);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const glm::dvec4 in(inputs[i]);
    const double expected = fibers(in.x, in.y, in.z, in.w);
    EXPECT_NEAR(found[i].x, expected, 1e-3 * expected + 1e-7);
  }
}

TEST_F(LobesTest, BrushedMetalStretchesHighlightsAlongItsDirection) {
  double across = 0, along = 0;
  for (const float rotation : {0.0f, 0.6f, 1.5707963f})
    for (const vec3& eye : kEyes)
      for (const vec3& direction : kSuns) {
        const Material material = metal(0.4f, 0.8f, rotation);
        const double found = shadeAt(plate(material, direction, 3), eye, {0, 0, 0}).x;
        const double expected = metalRadiance(material, onPlate(eye), onPlate(-direction), 3);
        EXPECT_NEAR(found, expected, 0.01 * expected + 1e-5) << rotation;
        if (&eye == &kEyes[1] && &direction == &kSuns[0]) (rotation == 0 ? along : across) = found;
      }
  EXPECT_GT(along, 5 * across) << "the eye is beside the mirrored sun, along the tangent";
}

TEST_F(LobesTest, TexturesTellColorRoughnessAndDirection) {
  Scene scene = plate(cloth({0.5f, 0.25f, 0}, {1, 1, 0.5f}, 1), {1, -1, 0}, 3);
  scene.textures = {plainTexture(4, 4, {255, 255, 128, 0}, false), plainTexture(4, 4, {9, 9, 9, 102}, false),
                    plainTexture(4, 4, {128, 255, 128, 0}, false)};
  scene.materials[0].sheenColorTexture.texture = 0;
  scene.materials[0].sheenRoughnessTexture.texture = 1;
  Material equal = scene.materials[0];
  equal.sheenColor.b *= 128 / 255.0f;
  equal.sheenRoughness = 0.4f;
  const vec3 eye{2, 1, 0.5f};
  const glm::vec4 found = shadeAt(scene, eye, {0, 0, 0});
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(found[c], clothRadiance(equal, c, onPlate(eye), onPlate({-1, 1, 0}), 3), 0.02) << c;

  scene.materials[0] = metal(0.4f, 1, 0);
  scene.materials[0].anisotropyTexture.texture = 2;
  const double expected = metalRadiance(metal(0.4f, 128 / 255.0f, 1.5707963f), onPlate(eye), onPlate({-1, 1, 0}), 3);
  EXPECT_NEAR(shadeAt(scene, eye, {0, 0, 0}).x, expected, 0.01 * expected);
}

TEST_F(LobesTest, OnlyScenesThatHaveThemPayForThem) {
  const Scene plain = plate(diffuse(vec3(0.5f)), {0, -1, 0}, 1);
  const Scene sheen = plate(cloth(vec3(0), vec3(1), 0.5f), {0, -1, 0}, 1);
  const Camera camera = lookAt({0, 2, 1}, {0, 0, 0});
  draw(plain, camera, 16, 16);
  EXPECT_FALSE(gbuffer.lobes);
  const std::size_t bytes = gbuffer.bytes();
  draw(sheen, camera, 16, 16);
  EXPECT_TRUE(gbuffer.lobes);
  EXPECT_EQ(gbuffer.bytes(), bytes + std::size_t{16} * 16 * 16);
  draw(plain, camera, 16, 16);
  EXPECT_FALSE(gbuffer.lobes);
  EXPECT_EQ(gbuffer.bytes(), bytes);
}

class LobesInMirrors : public RenderTest {};

// A coat over fibers over brushed metal, in pixels: each layer takes from those below it.
TEST_F(LobesInMirrors, ACoatLiesOverFibersAndBrushedMetal) {
  Material material = metal(0.6f, 0.8f, 0.6f);
  material.sheenColor = {0.5f, 0.25f, 0.1f};
  material.sheenRoughness = 0.5f;
  material.coat = 0.7f;
  material.coatRoughness = 0.45f;
  Settings settings = settingsWith({});
  settings.select.maxRoughness = 0.5f;  // a tenth of the coat's mirror is traced
  double most = 0;
  for (const vec3& eye : kEyes)
    for (const vec3& direction : kSuns) {
      const Frame frame = draw(plate(material, direction, 3), lookAt(eye, {0, 0, 0}), settings, 9, 9);
      const dvec3 v = onPlate(eye), l = onPlate(-direction), h = glm::normalize(v + l);
      const auto schlick = [](double cosine) { return 0.04 + 0.96 * std::pow(1 - cosine, 5); };
      const double film = 0.7 * schlick(v.z), coatAlpha = 0.45 * 0.45;
      const double highlight =
          0.7 * (1 - film * 0.1) * 3 * l.z * schlick(glm::dot(v, h)) * brushed(h, v, l, coatAlpha, coatAlpha);
      const double fewest = std::max(albedo(v.z, 0.5), albedo(l.z, 0.5));
      for (int c = 0; c < 3; ++c) {
        const double below = metalRadiance(material, v, l, 3) * (1 - 0.5 * fewest) +
                             3 * l.z * static_cast<double>(material.sheenColor[c]) * fibers(h.z, v.z, l.z, 0.5);
        const double expected = (1 - film) * below + highlight;
        EXPECT_NEAR(frame.at(4, 4, c == 0 ? "R" : c == 1 ? "G" : "B"), expected, 0.015 * expected + 1e-3) << c;
        most = std::max(most, highlight / expected);
      }
    }
  EXPECT_GT(most, 0.1) << "the coat's highlight has a say";
}

// A mirror at x = 0 shows the plate to its right, and a method that stores no attributes sees it as pixels are.
TEST_F(LobesInMirrors, WhatRaysFindIsLitAsPixelsAre) {
  const vec3 sunlight(-0.5f, -1, 0.3f);  // the mirror casts its shadow away from the plate
  for (const Material& material : {cloth({0.5f, 0.25f, 0}, {0.1f, 0.9f, 0.6f}, 0.5f), metal(0.8f, 0.7f, 0.6f)}) {
    Scene scene = plate(material, sunlight, 3);
    addQuad(scene, {0, 1, 0}, {0, 0, -2}, {0, 1, 0}, addMaterial(scene, mirror(1)));
    for (Vertex& vertex : scene.vertices) vertex.position.x += vertex.position.y == 0 && vertex.normal.y > 0 ? 2 : 0;
    const Camera camera = lookAt({2, 1.5f, 0}, {0, 0.9f, 0});
    constexpr int kWidth = 24, kHeight = 18;
    const Frame frame = draw(scene, camera, {}, kWidth, kHeight);
    const vec3 forward = glm::normalize(camera.target - camera.eye),
               right = glm::normalize(glm::cross(forward, {0, 1, 0})), up = glm::cross(right, forward);
    const float tangent = std::tan(0.5f * camera.verticalFov);
    int seen = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        if (frame.at(x, y, "selected.Y") == 0 || frame.at(x, y, "hit.ny") < 0.5f) continue;
        const float across = (2 * (static_cast<float>(x) + 0.5f) / kWidth - 1) * tangent * kWidth / kHeight;
        const float upwards = (1 - 2 * (static_cast<float>(y) + 0.5f) / kHeight) * tangent;
        vec3 toEye = -(forward + across * right + upwards * up);
        toEye.x = -toEye.x;
        const dvec3 v = onPlate(toEye), l = onPlate(-sunlight);
        const double expected =
            material.anisotropy > 0 ? metalRadiance(material, v, l, 3) : clothRadiance(material, 0, v, l, 3);
        EXPECT_NEAR(frame.at(x, y, "reflection.R"), expected, 0.01 * expected + 0.01);
        ++seen;
      }
    EXPECT_GT(seen, 30);
  }
}

}  // namespace
}  // namespace halfsilver::testing
