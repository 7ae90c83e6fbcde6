// Clear coats in pictures that blend deferred shading and reflections.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "gpu/light_fixture.h"
#include "gpu/shader_function.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

using glm::vec3;

constexpr int kSize = 33;  // the middle pixel looks along the camera's axis

class CoatTest : public TracingTest {
 protected:
  float middle(const Scene& scene, const Camera& camera, const Settings& settings) {
    frame_ = draw(scene, camera, settings, kSize, kSize);
    return frame_.at(kSize / 2, kSize / 2, "R");
  }
  float inMiddle(const std::string& channel) const { return frame_.at(kSize / 2, kSize / 2, channel); }

  Frame frame_;
};

// Rough, black, and without a mirror of its own.
Material black(float coat, float coatRoughness = 0) {
  Material material = plain(vec3(0));
  material.specular = 0;
  material.coat = coat;
  material.coatRoughness = coatRoughness;
  return material;
}

constexpr float kEmitted = 10;

// A floor at y = 0 below something that shines, at y = 2.
Scene belowAnEmitter(const Material& floor, const vec3& sky = vec3(0)) {
  Scene scene;
  Material emitter = black(0);
  emitter.emissive = vec3(kEmitted);
  scene.materials = {floor, emitter};
  addQuad(scene, {0, 0, 0}, {9, 0, 0}, {0, 0, -9}, 0);
  addQuad(scene, {0, 2, 0}, {9, 0, 0}, {0, 0, 9}, 1);
  scene.sky = evenSky(sky);
  return scene;
}
const Camera kDown = lookAt({0, 1, 0}, {0, 0, 0});
const Camera kSlanting = lookAt({0, 1, std::sqrt(3.0f)}, {0, 0, 0});  // 60 degrees from the normal

TEST_F(CoatTest, MirrorsByFresnelAndByItsShare) {
  const Settings settings;
  EXPECT_NEAR(middle(belowAnEmitter(black(1)), kDown, settings), 0.04f * kEmitted, 1e-3f);
  EXPECT_NEAR(inMiddle("reflectivity.Y"), 0.04f, 1e-4f);
  EXPECT_NEAR(inMiddle("reflection.R"), kEmitted, 1e-3f);
  EXPECT_NEAR(inMiddle("hit.T"), 2, 1e-3f);
  EXPECT_EQ(inMiddle("selected.Y"), 1);
  EXPECT_TRUE(frame_.report.warnings.empty()) << frame_.report.warnings.front();
  EXPECT_NEAR(middle(belowAnEmitter(black(0.5f)), kDown, settings), 0.02f * kEmitted, 1e-3f);
  EXPECT_NEAR(middle(belowAnEmitter(black(1)), kSlanting, settings), (0.04f + 0.96f / 32) * kEmitted, 1e-3f);
  EXPECT_EQ(middle(belowAnEmitter(black(0)), kDown, settings), 0);
  EXPECT_EQ(inMiddle("selected.Y"), 0);
}

TEST_F(CoatTest, AllMethodsAndShadowsByRaysShowIt) {
  for (const char* method : {"exact", "bvh", "attributes", "screen-first"})
    EXPECT_NEAR(middle(belowAnEmitter(black(1)), kDown, settingsWith({{"trace.method", method}})), 0.04f * kEmitted,
                5e-3f)
        << method;
  for (const char* shadows : {"rays", "refined"})
    EXPECT_NEAR(middle(belowAnEmitter(black(1)), kDown, settingsWith({{"shadow.method", shadows}})), 0.04f * kEmitted,
                1e-3f)
        << shadows;
}

// Under the sun, over bumps and seen in a mirror: the highlight is where the coat is even, by every method and however
// shadows are found.
TEST_F(CoatTest, ItsHighlightsAreSeenInMirrorsWhoeverTracesAndLights) {
  const auto seen = [this](const char* method, const char* shadows, bool bumpy, float coat) {
    Scene scene;
    scene.materials = {black(coat, 0.4f), mirrorMaterial()};
    scene.materials[1].mirror = 1.0f;
    scene.textures = {plainTexture(1, 1, {220, 128, 180, 255}, false)};
    if (bumpy) scene.materials[0].normalTexture.texture = 0;
    addQuad(scene, {0, 0, 0}, {9, 0, 0}, {0, 0, -9}, 0);
    addQuad(scene, {0, 1, -2}, {9, 0, 0}, {0, 1, 0}, 1);
    scene.sky = evenSky(vec3(0));
    scene.lights = {sun({0, -1, -4}, 3)};
    middle(scene, lookAt({0, 1, 1}, {0, 0.3f, -2}),
           settingsWith({{"trace.method", method}, {"shadow.method", shadows}}));
    return frame_.plane("reflection.R");
  };
  const std::vector<float> even = seen("identity", "maps", false, 1), without = seen("identity", "maps", true, 0);
  const float brightest = *std::max_element(even.begin(), even.end());
  EXPECT_GT(brightest, 0.1f);
  EXPECT_LT(*std::max_element(without.begin(), without.end()), 0.2f * brightest) << "it is the coat's";
  for (const char* method : {"identity", "exact", "bvh", "attributes"})
    for (const char* shadows : {"maps", "rays", "refined"}) {
      const std::vector<float> found = seen(method, shadows, true, 1);
      const bool stored = method == std::string("attributes");  // which know one normal of a surface
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < found.size(); ++i)
        wrong += std::abs(found[i] - even[i]) > 0.03f * brightest + 0.02f * even[i];
      if (stored)
        EXPECT_GT(*std::max_element(found.begin(), found.end()), 0.02f * brightest) << shadows;
      else
        EXPECT_LT(wrong, found.size() / 100) << method << " " << shadows;
    }
}

// The rays follow the mirror whose share is larger; the other one has the sky.
TEST_F(CoatTest, LeavesTheRaysToABetterMirrorBelow) {
  Material metal = plain(vec3(0.9f));
  metal.metallic = 1;
  metal.roughness = 0;
  metal.coat = 1;
  EXPECT_NEAR(middle(belowAnEmitter(metal), kDown, {}), 0.96f * 0.9f * kEmitted, 2e-3f);
  EXPECT_NEAR(inMiddle("reflectivity.Y"), 0.9f, 1e-3f);
  // Of a dull one the rays see nothing: its part of the sky is hidden.
  metal.roughness = 1;
  EXPECT_NEAR(middle(belowAnEmitter(metal), kDown, {}), 0.04f * kEmitted, 2e-3f);
  // Without a tracer, of the sky that is not hidden: both mirrors.
  metal.roughness = 0;
  Scene open = belowAnEmitter(metal, vec3(1));
  open.triangles.resize(2);
  EXPECT_NEAR(middle(open, kDown, settingsWith({{"trace.method", "none"}})), 0.04f + 0.96f * 0.9f, 2e-3f);
}

// A coat without a normal map of its own does not follow the bumps below it.
TEST_F(CoatTest, HasANormalOfItsOwn) {
  Material bumpy = black(1);
  bumpy.specular = 1;
  bumpy.roughness = 0.2f;
  Scene scene = belowAnEmitter(bumpy);
  scene.textures = {plainTexture(1, 1, {200, 128, 200, 255}, false)};
  scene.materials[0].normalTexture.texture = 0;
  EXPECT_NEAR(middle(scene, kDown, {}), 0.04f * kEmitted, 5e-3f);
  EXPECT_NEAR(inMiddle("normal.Y"), 1, 1e-5f);
  scene.materials[0].coat = 0;
  middle(scene, kDown, {});
  EXPECT_LT(inMiddle("normal.Y"), 0.9f);
}

// Straight up into a mirror that shines, which shows the floor below, which shows the mirror.
TEST_F(CoatTest, IsSeenInMirrors) {
  const auto seen = [this](float coat, const char* method) {
    Scene scene = belowAnEmitter(black(coat));
    scene.materials[1].mirror = 0.5f;
    return middle(scene, lookAt({0, 1, 0}, {0, 2, 0}),
                  settingsWith({{"trace.bounces", "2"}, {"trace.method", method}}));
  };
  for (const char* method : {"identity", "exact"}) {
    EXPECT_NEAR(seen(0, method), 0.5f * kEmitted, 1e-3f) << method;
    EXPECT_NEAR(seen(1, method), 0.5f * kEmitted + 0.5f * 0.04f * 0.5f * kEmitted, 1e-3f) << method;
  }
}

// Over nothing that reflects, it is the surface of a dielectric: the same highlights, however shadows are found.
TEST_F(CoatTest, HasTheHighlightsOfADielectric) {
  const Camera camera = lookAt({0, 1, 1}, {0, 0, 0});
  for (const char* shadows : {"maps", "rays", "refined"}) {
    const auto lit = [&](const Material& material) {
      Scene scene = belowAnEmitter(material);
      scene.triangles.resize(2);
      scene.lights = {sun({0, -1, 1}, 3)};
      middle(scene, camera, settingsWith({{"shadow.method", shadows}}));
      return frame_.plane("R");
    };
    Material dielectric = black(0);
    dielectric.specular = 1;
    dielectric.roughness = 0.3f;
    const std::vector<float> coated = lit(black(1, 0.3f)), plain = lit(dielectric), base = lit(black(0));
    EXPECT_GT(*std::max_element(plain.begin(), plain.end()), 0.5f) << shadows;
    EXPECT_LT(*std::max_element(base.begin(), base.end()), 0.05f) << "it glances where nearly nothing is seen";
    for (std::size_t i = 0; i < plain.size(); ++i) {
      EXPECT_GE(coated[i], 0.999f * plain[i] - 1e-4f) << shadows;
      EXPECT_LE(coated[i], 1.001f * plain[i] + base[i] + 1e-4f) << shadows;
    }
  }
}

// Rough coats spread their reflection as rough surfaces do.
TEST_F(CoatTest, IsGlossy) {
  const auto lit = [this](const Material& material) {
    return middle(belowAnEmitter(material), kDown,
                  settingsWith({{"effect.glossy", "true"}, {"effect.samples", "64"}, {"select.max_roughness", "1"}}));
  };
  Material dielectric = black(0);
  dielectric.specular = 1;
  dielectric.roughness = 0.3f;
  const float expected = lit(dielectric);
  EXPECT_GT(expected, 0.025f * kEmitted);
  EXPECT_NEAR(lit(black(1, 0.3f)), expected, 1e-3f * kEmitted);
}

TEST_F(CoatTest, OnlyEffectsThatShowItSaySo) {
  const auto warns = [this](const char* effect) {
    middle(belowAnEmitter(black(1)), kDown, settingsWith({{"trace.effect", effect}}));
    for (const std::string& warning : frame_.report.warnings)
      if (warning.find("coat") != std::string::npos) return true;
    return false;
  };
  for (const char* effect : {"reflection", "whitted", "occlusion", "path"}) EXPECT_FALSE(warns(effect)) << effect;
  EXPECT_TRUE(warns("layers"));
}

}  // namespace
}  // namespace halfsilver::testing
