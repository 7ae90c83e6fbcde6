// Scattering at one surface: what goes in comes out.
#include <cmath>
#include <vector>

#include "effects/energy_table.h"
#include "gpu/context_fixture.h"
#include "gpu/shader_function.h"

namespace halfsilver::testing {
namespace {

using glm::vec4;

constexpr const char* kScatter = R"(
  vec4 a = inputs[2 * item], b = inputs[2 * item + 1];  // metallic, roughness, coat, its roughness; transmission, cosine, eta (negative: thin)
  Surface s;
  s.position = vec3(0.0);
  s.geometricNormal = s.normal = s.coatNormal = vec3(0.0, 0.0, 1.0);
  s.baseColor = vec3(1.0);
  s.emissive = vec3(0.0);
  s.metallic = a.x;
  s.roughness = a.y;
  s.f0 = mix(vec3(0.04), vec3(1.0), a.x);
  s.occlusion = 1.0;
  s.reflectivity = 1.0;
  s.unlit = false;
  leaveOutLayers(s);
  s.coat = a.z;
  s.coatRoughness = a.w;
  s.transmission = b.x;
  s.ior = abs(b.z);
  s.thin = b.z < 0.0;
  Bsdf bsdf = makeBsdf(s, vec3(sqrt(1.0 - b.y * b.y), 0.0, b.y));
  float sum = 0.0, passed = 0.0, density = 0.0;
  const uint COUNT = 4000u;
  for (uint i = 0u; i < COUNT; ++i) {
    vec4 numbers = fract(0.5 + (float(i) + b.w * float(COUNT)) * vec4(0.8566749, 0.7338919, 0.6287067, 0.5385973));
    Scattering next = scatter(bsdf, s, abs(b.z), numbers.xy, numbers.zw);
    sum += next.weight.g;
    if (next.passes) passed += next.weight.g;
    // A density over the half sphere, summed over even directions, is the chance that one is chosen.
    float z = numbers.x, turn = 6.2831853 * numbers.y, at;
    evaluateBsdf(bsdf, s, vec3(sqrt(1.0 - z * z) * vec2(cos(turn), sin(turn)), z), at);
    density += 6.2831853 * at;
  }
  outputs[item] = vec4(sum, passed, density, 0.0) / float(COUNT);
)";

class BsdfTest : public ContextTest {
 protected:
  // Weight of all that is scattered, weight of what passes, chance of all directions of the half sphere.
  std::vector<vec4> scattered(const std::vector<vec4>& surfaces) {
    EnergyTable table(api);
    const ShaderFunction function(api, "lib/bsdf.glsl", kScatter, 2, 1);
    table.bind();
    // A driver may end loops early: parts of 4,000.
    constexpr int kParts = 8;
    std::vector<vec4> means(surfaces.size() / 2, vec4(0));
    for (int part = 0; part < kParts; ++part) {
      std::vector<vec4> inputs = surfaces;
      for (std::size_t i = 1; i < inputs.size(); i += 2) inputs[i].w = static_cast<float>(part);
      const std::vector<vec4> results = function.run(inputs);
      for (std::size_t i = 0; i < means.size(); ++i) means[i] += results[i] / static_cast<float>(kParts);
    }
    return means;
  }
};

TEST_F(BsdfTest, WhiteSurfacesGiveBackWhatTheyReceive) {
  std::vector<vec4> surfaces;
  for (const float metallic : {0.0f, 1.0f})
    for (const float roughness : {0.0f, 0.15f, 0.4f, 0.7f, 1.0f})
      for (const float coat : {0.0f, 0.6f, 1.0f})
        for (const float transmission : {0.0f, 0.5f, 1.0f})
          for (const float eta : {1.5f, 1 / 1.5f, 1.2f, 2.3f, 1 / 2.3f, -1.5f})
            for (const float cosine : {1.0f, 0.7f, 0.4f, 0.15f}) {
              surfaces.emplace_back(metallic, roughness, coat, 0.3f);
              surfaces.emplace_back(transmission, cosine, eta, 0);
            }
  const std::vector<vec4> results = scattered(surfaces);
  for (std::size_t i = 0; i < results.size(); ++i) {
    const vec4& a = surfaces[2 * i];
    const vec4& b = surfaces[2 * i + 1];
    EXPECT_NEAR(results[i].x, 1, 0.01f) << "metallic " << a.x << " roughness " << a.y << " coat " << a.z
                                        << " transmission " << b.x << " cosine " << b.y << " eta " << b.z;
  }
}

TEST_F(BsdfTest, DensitiesAddUpToAllChances) {
  std::vector<vec4> surfaces;
  for (const float roughness : {0.3f, 0.6f, 1.0f})
    for (const float coat : {0.0f, 1.0f}) {
      surfaces.emplace_back(0, roughness, coat, 0.4f);
      surfaces.emplace_back(0, 0.8f, 1.5f, 0);
    }
  for (const vec4& result : scattered(surfaces)) EXPECT_NEAR(result.z, 1, 0.03f);
}

TEST_F(BsdfTest, SmoothGlassPassesWhatFresnelLeavesAndNothingBeyondTheCriticalAngle) {
  const auto passed = [&](float cosine, float eta) { return scattered({{0, 0, 0, 0}, {1, cosine, eta, 0}})[0].y; };
  EXPECT_NEAR(passed(1, 1.5f), 0.96, 0.001);
  EXPECT_NEAR(passed(1, 1 / 1.5f), 0.96, 0.001);
  const double critical = std::sqrt(1 - 1 / (1.5 * 1.5));  // cosine
  EXPECT_EQ(passed(static_cast<float>(critical - 0.002), 1 / 1.5f), 0);
  EXPECT_GT(passed(static_cast<float>(critical + 0.002), 1 / 1.5f), 0.2f);
}

}  // namespace
}  // namespace halfsilver::testing
