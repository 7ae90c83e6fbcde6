// Screen first, then structure: what the screen answers is right, and what it does not is the structure's to the bit.
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <halfsilver/builtin.h>
#include "gpu/light_fixture.h"
#include "gpu/tracing_scenes.h"
#include "shared/passes/screen.h"

namespace halfsilver::testing {
namespace {

using glm::vec3;

constexpr float kScreen = ANSWER_FIRST, kStructure = ANSWER_STRUCTURE;

const Settings kFirst = settingsWith({{"trace.method", "screen-first"}}),
               kIdentity = settingsWith({{"trace.method", "identity"}}),
               kExact = settingsWith({{"trace.method", "exact"}});

class ScreenFirstTest : public TracingTest {
 protected:
  // Rays of the frame that were answered so and are wrong.
  static std::size_t wrong(const Frame& frame, const Frame& exact, float answer, float diagonal) {
    const std::vector<float> who = frame.plane("answered.Y"), t = frame.plane("hit.T"), truth = exact.plane("hit.T");
    std::size_t count = 0;
    for (std::size_t i = 0; i < t.size(); ++i)
      count += who[i] == answer && ((t[i] >= 0) != (truth[i] >= 0) || std::abs(t[i] - truth[i]) > 1e-3f * diagonal);
    return count;
  }
  static std::size_t answered(const Frame& frame, float answer) {
    const std::vector<float> who = frame.plane("answered.Y");
    return static_cast<std::size_t>(std::count(who.begin(), who.end(), answer));
  }
};

class ScreenFirstScenes : public ScreenFirstTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(ScreenFirstScenes, TheScreenIsRightAndTheStructureIsExact) {
  const Scene scene = makeBuiltin(GetParam()).scene;
  const Camera& camera = scene.cameras.front();
  const Frame frame = draw(scene, camera, kFirst, 384, 216), exact = draw(scene, camera, kExact, 384, 216),
              identity = draw(scene, camera, kIdentity, 384, 216);
  const float diagonal = scene.bounds().diagonal();
  const std::size_t rays = frame.report.selected;
  EXPECT_EQ(answered(frame, kScreen) + answered(frame, kStructure), rays);
  EXPECT_EQ(frame.report.rays[COUNT_ANSWERED_FIRST], answered(frame, kScreen));
  EXPECT_EQ(frame.report.rays[COUNT_ANSWERED_BY_STRUCTURE], answered(frame, kStructure));
  EXPECT_GT(answered(frame, kScreen), rays / 6);
  EXPECT_GT(answered(frame, kStructure), rays / 6);
  EXPECT_EQ(wrong(frame, exact, kStructure, diagonal), 0u);
  EXPECT_LE(static_cast<double>(wrong(frame, exact, kScreen, diagonal)), 0.001 * static_cast<double>(rays));
  const std::vector<float> who = frame.plane("answered.Y");
  for (const char* layer : {"hit.T", "hit.id", "hit.nx", "reflection.G"}) {
    const std::vector<float> mine = frame.plane(layer), its = identity.plane(layer);
    for (std::size_t i = 0; i < who.size(); ++i) {
      if (who[i] != kScreen) {
        ASSERT_EQ(mine[i], its[i]) << layer << " " << i;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Builtin, ScreenFirstScenes, ::testing::Values("sphere", "teapot"));

// A mirror floor before a wall.
Scene floorBeforeWall() {
  Scene scene;
  addQuad(scene, vec3(0), {3, 0, 0}, {0, 0, -3}, addMaterial(scene, mirrorMaterial()));
  addQuad(scene, {0, 1, -3}, {3, 0, 0}, {0, 1, 0}, addMaterial(scene, plain({0.8f, 0.2f, 0.1f})));
  return scene;
}
const Camera kBeforeWall = lookAt({0, 1.2f, 4}, {0, 0.8f, -3});

// The floor shows the front of a sheet of which the camera sees the back, that is nothing: the wall behind it.
TEST_F(ScreenFirstTest, BacksThatTheCameraLooksThroughAreNoEmptySpace) {
  Scene scene = floorBeforeWall();
  addQuad(scene, {0, 1, -1}, {2, 0, 0}, {0, 0, 1}, addMaterial(scene, plain({0.1f, 0.9f, 0.1f})));
  const Camera camera = lookAt({0, 2.5f, 4}, {0, 0.8f, -3});
  const Frame frame = draw(scene, camera, kFirst, 160, 120), exact = draw(scene, camera, kExact, 160, 120);
  const std::vector<float> id = exact.plane("hit.id"), who = frame.plane("answered.Y");
  std::size_t onSheet = 0;
  for (std::size_t i = 0; i < id.size(); ++i) {
    if (id[i] < 4) continue;
    ++onSheet;
    EXPECT_EQ(who[i], kStructure);
  }
  EXPECT_GT(onSheet, 100u);
  EXPECT_GT(answered(frame, kScreen), 500u) << "of the wall beside it";
  EXPECT_EQ(frame.plane("hit.T"), draw(scene, camera, kIdentity, 160, 120).plane("hit.T"));
}

TEST_F(ScreenFirstTest, ARayThatEndsBeforeAllThatIsSeenIsCertainToMiss) {
  Scene scene;
  addQuad(scene, vec3(0), {3, 0, 0}, {0, 0, -3}, addMaterial(scene, mirrorMaterial()));
  const Frame frame = draw(scene, lookAt({0, 6, 1}, {0, 0, 0}), kFirst, 64, 48);
  EXPECT_GT(frame.report.selected, 500u);
  EXPECT_EQ(frame.report.rays[COUNT_ANSWERED_FIRST], frame.report.selected);
  for (const float t : frame.plane("hit.T")) EXPECT_LT(t, 0);
}

TEST_F(ScreenFirstTest, LaterRaysAreAnsweredLikewise) {
  Scene scene = floorBeforeWall();
  scene.materials[1] = mirrorMaterial();  // of the wall
  addQuad(scene, {0, 0.5f, -1}, {0.4f, 0, 0}, {0, 0.4f, 0}, addMaterial(scene, plain({0.1f, 0.9f, 0.1f})));
  const auto bounce = [&](const char* method) {
    return draw(scene, kBeforeWall, settingsWith({{"trace.method", method}, {"trace.bounces", "3"}}), 96, 72);
  };
  const Frame frame = bounce("screen-first"), identity = bounce("identity");
  EXPECT_EQ(frame.report.rays[RAY_REFLECTION], identity.report.rays[RAY_REFLECTION]);
  EXPECT_GT(frame.report.rays[COUNT_ANSWERED_FIRST] + frame.report.rays[COUNT_ANSWERED_BY_STRUCTURE],
            frame.report.selected + 500);
  EXPECT_EQ(answered(frame, kScreen) + answered(frame, kStructure), frame.report.selected) << "the first rays";
  EXPECT_EQ(frame.plane("reflection.R"), identity.plane("reflection.R"));
}

TEST_F(ScreenFirstTest, AFrameAfterAMoveIsLikeANewOne) {
  Scene scene = floorBeforeWall();
  addQuad(scene, {0, 0.5f, -1}, {0.4f, 0, 0}, {0, 0.4f, 0}, addMaterial(scene, plain({0.1f, 0.9f, 0.1f})));
  Renderer renderer = makeRenderer(scene);
  const Camera aside = lookAt({0.7f, 1.4f, 3.5f}, {0.2f, 0.6f, -3});
  drawWith(renderer, kBeforeWall, kFirst, 160, 120);
  EXPECT_EQ(drawWith(renderer, aside, kFirst, 160, 120).layers.data, draw(scene, aside, kFirst, 160, 120).layers.data);
  for (std::size_t i = 8; i < scene.vertices.size(); ++i) scene.vertices[i].position.x += 0.7f;
  const VertexRange moved{8, 4};
  renderer.updateVertices(scene, std::span(&moved, 1));
  EXPECT_EQ(drawWith(renderer, aside, kFirst, 160, 120).layers.data, draw(scene, aside, kFirst, 160, 120).layers.data);
}

}  // namespace
}  // namespace halfsilver::testing
