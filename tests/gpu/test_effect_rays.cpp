// Rays of all kinds over whole scenes: the default method beside exact rays.
#include <filesystem>
#include <iterator>
#include <string>

#include <halfsilver/builtin.h>
#include <halfsilver/io.h>
#include "gpu/ray_witness.h"
#include "shared_scenes.h"

namespace halfsilver::testing {
namespace {

constexpr const char* kKinds[] = {"reflection", "refraction", "shadow", "occlusion", "scattered", "through"};

class EffectRays : public WitnessTest {
 protected:
  // Draws with each effect and expects no wrong ray of any kind.
  void expectRight(const Scene& scene, const Camera& camera) {
    for (const char* effect : {"occlusion", "whitted", "path", "layers"}) {
      SCOPED_TRACE(effect);
      *counts_ = {};
      Settings settings = settingsWith({{"trace.effect", effect}, {"trace.bounces", "2"}, {"effect.samples", "2"}});
      settings.trace.method = "witnessed";
      const Frame frame = draw(scene, camera, settings, 96, 54);
      std::uint64_t rays = 0, hits = 0;  // of all kinds
      for (std::size_t kind = 0; kind < std::size(kKinds); ++kind) {
        const Witness& witness = (*counts_)[kind];
        rays += witness.rays;
        hits += witness.hits;
        EXPECT_EQ(witness.falseOcclusion, 0u) << kKinds[kind];
        EXPECT_EQ(witness.falseVisibility, 0u) << kKinds[kind];
        EXPECT_EQ(witness.wrongDistance, 0u) << kKinds[kind];
        EXPECT_LE(witness.atEdges, witness.rays / 10000) << kKinds[kind];
      }
      EXPECT_EQ(frame.report.overflow, 0u);
      EXPECT_GT(rays, 2000u);
      EXPECT_GT(hits, 40u);
      RecordProperty(std::string(effect) + "_rays", std::to_string(rays));
    }
  }
};

class EffectRaysIn : public EffectRays, public ::testing::WithParamInterface<const char*> {};

TEST_P(EffectRaysIn, AreRightOverTheDefault) {
  const Scene scene = makeBuiltin(GetParam()).scene;
  expectRight(scene, scene.cameras.front());
}

INSTANTIATE_TEST_SUITE_P(Builtin, EffectRaysIn, ::testing::Values("teapot", "atrium", "rods", "glass"),
                         [](const auto& scene) { return std::string(scene.param); });

TEST_F(EffectRays, AreRightOverTheDefaultInSponza) {
  const std::filesystem::path file = sharedScene("sponza.glb");
  HALFSILVER_REQUIRE_SCENE(file);
  expectRight(loadGltf(file).scene, lookAt({13, 1.2f, 0.4f}, {-5, 2.6f, -0.2f}));
}

}  // namespace
}  // namespace halfsilver::testing
