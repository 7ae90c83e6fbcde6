// The screen-space method: right about what the camera sees, silent about the rest.
#include <cmath>
#include <vector>

#include "gpu/light_fixture.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

using glm::vec3;

const Settings kScreen = settingsWith({{"trace.method", "screen-space"}}),
               kExact = settingsWith({{"trace.method", "exact"}});

class ScreenSpaceTest : public TracingTest {};

// A mirror floor before a tiled wall: each reflected ray that meets the wall does so where the camera sees it.
Scene floorBeforeWall() {
  Scene scene;
  addQuad(scene, vec3(0), {3, 0, 0}, {0, 0, -3}, addMaterial(scene, mirrorMaterial()));
  const std::uint32_t colors[] = {addMaterial(scene, plain({0.8f, 0.2f, 0.1f})),
                                  addMaterial(scene, plain({0.1f, 0.3f, 0.8f}))};
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 24; ++x)
      addQuad(scene, {0.25f * static_cast<float>(x) - 2.875f, 0.25f * static_cast<float>(y) + 0.125f, -3},
              {0.125f, 0, 0}, {0, 0.125f, 0}, colors[(x + y) % 2]);
  return scene;
}
const Camera kBeforeWall = lookAt({0, 1.2f, 4}, {0, 0.8f, -3});

TEST_F(ScreenSpaceTest, HitsOnWhatIsSeenAreExact) {
  const Scene scene = floorBeforeWall();
  const Frame screen = draw(scene, kBeforeWall, kScreen, 160, 120), exact = draw(scene, kBeforeWall, kExact, 160, 120);
  const HitErrors errors = compareHits(screen, exact, scene.bounds().diagonal());
  expectNontrivial(errors, exact);
  // Along the wall's outline alone.
  EXPECT_LT(errors.falseHit, 0.001);
  EXPECT_LT(errors.hitError, 0.01);
  EXPECT_LT(errors.wrongId, 0.005);
  RecordProperty("hit_error", std::to_string(errors.hitError));
  EXPECT_EQ(screen.report.overflow, 0u);
  EXPECT_GT(screen.report.memory.structureTotal, 160u * 120 * 4);
  EXPECT_LT(screen.report.memory.structureTotal, 160u * 128 * 6);
}

TEST_F(ScreenSpaceTest, WhatTheCameraDoesNotSeeIsNotThere) {
  Scene scene = floorBeforeWall();
  // The floor shows the front of a sheet of which the camera sees the back, that is nothing.
  addQuad(scene, {0, 1, -1}, {2, 0, 0}, {0, 0, 1}, addMaterial(scene, plain({0.1f, 0.9f, 0.1f})));
  const auto onSheet = [&](const Settings& settings) {
    std::size_t rays = 0;
    for (const float id : draw(scene, kBeforeWall, settings, 160, 120).plane("hit.id"))
      rays += id >= static_cast<float>(scene.triangles.size() - 2);
    return rays;
  };
  EXPECT_GT(onSheet(kExact), 100u);
  EXPECT_EQ(onSheet(kScreen), 0u);
}

TEST_F(ScreenSpaceTest, AMovingCameraHasAPyramidOfItsOwnInEachFrame) {
  const Scene scene = floorBeforeWall();
  Renderer renderer = makeRenderer(scene);
  const Camera aside = lookAt({0.7f, 1.4f, 3.5f}, {0.2f, 0.6f, -3});
  drawWith(renderer, kBeforeWall, kScreen, 160, 120);
  const Frame moved = drawWith(renderer, aside, kScreen, 160, 120);
  EXPECT_EQ(moved.layers.data, draw(scene, aside, kScreen, 160, 120).layers.data);
}

}  // namespace
}  // namespace halfsilver::testing
