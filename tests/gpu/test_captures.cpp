// Methods that capture the scene from somewhere else: a planar reflection and a cube around a probe.
#include <algorithm>
#include <vector>

#include "gpu/light_fixture.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

using glm::vec3;

const Settings kPlanar = settingsWith({{"trace.method", "planar"}}),
               kCubemap = settingsWith({{"trace.method", "cubemap"}, {"abuffer.resolution", "512"}}),
               kExact = settingsWith({{"trace.method", "exact"}});

class CaptureTest : public TracingTest {};

// A mirror floor before a wall, and a sheet over it of which the camera sees the back, that is nothing.
Scene floorUnderSheet(const Material& wall) {
  Scene scene;
  addQuad(scene, vec3(0), {3, 0, 0}, {0, 0, -3}, addMaterial(scene, mirrorMaterial()));
  addQuad(scene, {0, 1, -3}, {3, 0, 0}, {0, 1, 0}, addMaterial(scene, wall));
  addQuad(scene, {0, 1, -1}, {2, 0, 0}, {0, 0, 1}, addMaterial(scene, plain({0.1f, 0.9f, 0.1f})));
  return scene;
}
const Camera kBeforeWall = lookAt({0, 2.5f, 4}, {0, 0.8f, -3});

TEST_F(CaptureTest, APlanarReflectionIsExactOnAndOffTheScreen) {
  const Scene scene = floorUnderSheet(plain({0.8f, 0.2f, 0.1f}));
  const Frame frame = draw(scene, kBeforeWall, kPlanar, 160, 120), exact = draw(scene, kBeforeWall, kExact, 160, 120);
  const HitErrors errors = compareHits(frame, exact, scene.bounds().diagonal());
  EXPECT_GT(errors.rays, 3000u);
  EXPECT_EQ(errors.falseHit, 0);
  EXPECT_LT(errors.hitError, 0.002);
  EXPECT_LT(errors.wrongId, 0.002);
  std::size_t onSheet = 0;
  for (const float id : frame.plane("hit.id")) onSheet += id >= 4;
  EXPECT_GT(onSheet, 100u);
  EXPECT_GE(frame.report.memory.structureTotal, 160u * 120 * 8);
}

TEST_F(CaptureTest, OtherMirrorsThanThePlanesShowTheSky) {
  const Scene scene = floorUnderSheet(mirrorMaterial());
  const Frame frame = draw(scene, kBeforeWall, kPlanar, 160, 120), exact = draw(scene, kBeforeWall, kExact, 160, 120);
  const std::vector<float> selected = frame.plane("selected.Y"), up = frame.plane("normal.Y"), t = frame.plane("hit.T"),
                           truth = exact.plane("hit.T");
  std::size_t floor = 0, wall = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (selected[i] == 0) continue;
    if (up[i] > 0.9f) {
      ++floor;
    } else {
      ++wall;
      EXPECT_EQ(t[i], -1.0f);
    }
  }
  EXPECT_GT(wall, 500u);
  EXPECT_GT(floor, wall) << "or the plane is the wall's";
  EXPECT_GT(compareHits(frame, exact, scene.bounds().diagonal()).falseMiss, 0.01);
}

TEST_F(CaptureTest, WithoutAReflectingPixelThereIsNoPlane) {
  Scene scene;
  addQuad(scene, vec3(0), {3, 0, 0}, {0, 0, -3}, addMaterial(scene, plain({0.5f, 0.5f, 0.5f})));
  for (const Settings& settings : {kPlanar, kCubemap}) {
    const Frame frame = draw(scene, kBeforeWall, settings, 64, 48);
    EXPECT_EQ(frame.report.selected, 0u);
  }
}

// In an empty box the parallax of the box is the truth, to a texel.
TEST_F(CaptureTest, ACubeInABoxShowsItsWallsInTheirPlaces) {
  Scene scene;
  addBox(scene, {-3, 0, -2}, {3, 2.5f, 2}, addMaterial(scene, plain({0.8f, 0.7f, 0.6f})), true);
  addQuad(scene, {0, 0.01f, 0}, {1, 0, 0}, {0, 0, -1}, addMaterial(scene, mirrorMaterial()));
  const Camera camera = lookAt({0, 1.6f, 1.8f}, {0, 0, -0.2f});
  const Frame frame = draw(scene, camera, kCubemap, 160, 120), exact = draw(scene, camera, kExact, 160, 120);
  const HitErrors errors = compareHits(frame, exact, 10 * scene.bounds().diagonal());  // within 1 %
  EXPECT_GT(errors.rays, 1000u);
  EXPECT_EQ(errors.falseMiss, 0);
  EXPECT_LT(errors.hitError, 0.01);
  EXPECT_LT(errors.wrongId, 0.03);
  std::vector<float> walls = exact.plane("hit.id");
  std::sort(walls.begin(), walls.end());
  EXPECT_GT(std::unique(walls.begin(), walls.end()) - walls.begin(), 4) << "several walls, in two triangles each";
}

TEST_F(CaptureTest, AMovingCameraHasCapturesOfItsOwnInEachFrame) {
  const Scene scene = floorUnderSheet(plain({0.8f, 0.2f, 0.1f}));
  const Camera aside = lookAt({0.7f, 2.2f, 3.5f}, {0.2f, 0.6f, -3});
  for (const Settings& settings : {kPlanar, kCubemap}) {
    Renderer renderer = makeRenderer(scene);
    drawWith(renderer, kBeforeWall, settings, 96, 72);
    EXPECT_EQ(drawWith(renderer, aside, settings, 96, 72).layers.data,
              draw(scene, aside, settings, 96, 72).layers.data);
  }
}

}  // namespace
}  // namespace halfsilver::testing
