// Voxels without A-buffers.
#include <string>
#include <vector>

#include <halfsilver/io.h>
#include "gpu/shader_function.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

class VoxelsTest : public TracingTest {
 protected:
  static Settings voxels(std::initializer_list<std::pair<const char*, const char*>> more = {}) {
    Settings settings = settingsWith({});
    applyPreset(settings, "voxels");
    set(settings, "voxels.resolution", "32");
    for (const auto& [name, value] : more) set(settings, name, value);
    return settings;
  }
};

// A wall behind a mirror: its voxels lie before it, by up to a voxel.
Scene wall() {
  Scene scene;
  scene.materials = {mirrorMaterial(), plain({0.9f, 0.1f, 0.1f})};
  addQuad(scene, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, 0);
  addQuad(scene, {-2, 0.5f, -1.45f}, {2, 0.5f, -1.45f}, {2, 4, -1.45f}, {-2, 4, -1.45f}, 1);
  return scene;
}

TEST_F(VoxelsTest, AreHitWhereARayEntersThem) {
  const Scene scene = wall();
  const Camera camera = lookAt({0, 1.5f, 2}, {0, 0, 0});
  const Frame exact = draw(scene, camera, settingsWith({{"trace.method", "exact"}}), 80, 60);
  const Frame frame = draw(scene, camera, voxels(), 80, 60);
  const float diagonal = 4.0f / 32 * 1.8f;
  std::size_t hits = 0, missed = 0;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x) {
      const float truth = exact.at(x, y, "hit.T"), t = frame.at(x, y, "hit.T");
      if (truth < 0) continue;
      ++hits;
      if (t < 0) {
        ++missed;
        continue;
      }
      EXPECT_LE(t, truth + 1e-4f) << x << " " << y;
      EXPECT_GE(t, truth - diagonal) << x << " " << y;
      EXPECT_GE(frame.at(x, y, "hit.id"), 2.0f);
      EXPECT_GT(frame.at(x, y, "hit.nz"), 0.99f) << "the average of one wall's normals is its own";
      // The wall is red, and so is what rays bring of it.
      EXPECT_GT(frame.at(x, y, "reflection.R"), 2 * frame.at(x, y, "reflection.G"));
    }
  EXPECT_GT(hits, 500u);
  EXPECT_EQ(missed, 0u);
}

// Voxels have the scene's proportions, so they are long here, and the mirror's own lie on the way of many rays.
TEST_F(VoxelsTest, OfALongSceneDoNotHideWhatAMirrorSees) {
  Scene scene;
  scene.materials = {mirrorMaterial(), plain({0.9f, 0.1f, 0.1f})};
  addQuad(scene, {-1, 0, 0}, {1, 0, 0}, {1, 2, 0}, {-1, 2, 0}, 0);
  addQuad(scene, {1, 0, 40}, {-1, 0, 40}, {-1, 2, 40}, {1, 2, 40}, 1);
  const Camera camera = lookAt({0, 1, 2}, {0, 1, 0});
  const Frame exact = draw(scene, camera, settingsWith({{"trace.method", "exact"}}), 80, 60);
  const Frame frame = draw(scene, camera, voxels({{"voxels.resolution", "64"}}), 80, 60);
  std::size_t rays = 0, falseHits = 0;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x) {
      if (exact.at(x, y, "selected.Y") == 0) continue;
      ++rays;
      falseHits += exact.at(x, y, "hit.T") < 0 && frame.at(x, y, "hit.T") >= 0 ? 1u : 0u;
    }
  EXPECT_GT(rays, 1000u);
  EXPECT_LT(falseHits, rays / 50);
}

TEST_F(VoxelsTest, AreKeptWhileNothingMovesAndTakeTwelveBytes) {
  Scene scene = wall();
  Renderer renderer = makeRenderer(scene);
  const Camera camera = lookAt({0, 1.5f, 2}, {0, 0, 0});
  const auto built = [](const Frame& frame) {
    for (const StageTime& time : frame.report.times)
      if (time.stage == "voxelize" && time.milliseconds > 0) return true;
    return false;
  };
  const Frame first = drawWith(renderer, camera, voxels(), 80, 60);
  EXPECT_TRUE(built(first));
  EXPECT_EQ(first.report.memory.structureTotal, 32u * 32u * 32u * 12u);
  EXPECT_FALSE(built(drawWith(renderer, camera, voxels(), 80, 60)));

  for (Vertex& vertex : scene.vertices)
    if (vertex.position.z == -1.45f) vertex.position.z = -1.0f;
  renderer.setScene(scene);
  const Frame moved = drawWith(renderer, camera, voxels(), 80, 60);
  EXPECT_TRUE(built(moved));
  EXPECT_NE(moved.plane("hit.T"), first.plane("hit.T"));
}

}  // namespace
}  // namespace halfsilver::testing
