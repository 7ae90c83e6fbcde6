#include <gtest/gtest.h>

#include <cmath>

#include "gpu/tracing_scenes.h"

namespace halfsilver {
namespace {

using testing::addTriangle;
using testing::lookAt;
using testing::plain;
using testing::settingsWith;

constexpr int kWidth = 96, kHeight = 54;

// A wall at z = 0 and a card before it, whose vertices come last.
Scene wallAndCard() {
  Scene scene;
  scene.materials = {plain(glm::vec3(0.8f)), plain(glm::vec3(0.2f, 0.4f, 0.8f))};
  addTriangle(scene, {-9, -9, 0}, {9, -9, 0}, {0, 12, 0}, 0);
  addTriangle(scene, {-0.5f, -0.5f, 1}, {0.5f, -0.5f, 1}, {0, 0.8f, 1}, 1);
  return scene;
}

class MotionTest : public testing::RenderTest {
 protected:
  Settings settings_ = settingsWith({{"select.mode", "none"}, {"image.motion", "true"}, {"shadow.resolution", "64"}});
  const Camera camera_ = lookAt({0, 0, 4}, {0, 0, 0});
  // Pixels per meter in a plane that many meters before the camera.
  static double scale(double distance) { return 0.5 * kHeight / std::tan(glm::radians(30.0)) / distance; }
};

TEST_F(MotionTest, NothingMovesInAFirstOrAStillFrame) {
  const Scene scene = wallAndCard();
  Renderer renderer = makeRenderer(scene);
  for (int frame = 0; frame < 3; ++frame) {
    const testing::Frame drawn = drawWith(renderer, camera_, settings_, kWidth, kHeight);
    for (const char* channel : {"motion.X", "motion.Y"})
      for (const float value : drawn.plane(channel)) ASSERT_EQ(value, 0);
  }
}

TEST_F(MotionTest, AMovedCardMovesAsManyPixelsAsItsDistanceSays) {
  Scene scene = wallAndCard();
  Renderer renderer = makeRenderer(scene);
  drawWith(renderer, camera_, settings_, kWidth, kHeight);
  const VertexRange card{3, 3};
  for (std::size_t i = 3; i < 6; ++i) scene.vertices[i].position += glm::vec3(0.1f, 0.05f, 0);
  renderer.updateVertices(scene, std::span(&card, 1));
  const testing::Frame moved = drawWith(renderer, camera_, settings_, kWidth, kHeight);
  EXPECT_NEAR(moved.at(kWidth / 2, kHeight / 2, "motion.X"), 0.1 * scale(3), 1e-3);
  EXPECT_NEAR(moved.at(kWidth / 2, kHeight / 2, "motion.Y"), -0.05 * scale(3), 1e-3) << "up is towards the first row";
  EXPECT_EQ(moved.at(5, kHeight - 5, "motion.X"), 0) << "the wall stays";
  const testing::Frame still = drawWith(renderer, camera_, settings_, kWidth, kHeight);
  EXPECT_EQ(still.at(kWidth / 2, kHeight / 2, "motion.X"), 0) << "a frame later it rests";
}

TEST_F(MotionTest, TwoMovesBetweenFramesAddUp) {
  Scene scene = wallAndCard();
  Renderer renderer = makeRenderer(scene);
  drawWith(renderer, camera_, settings_, kWidth, kHeight);
  const VertexRange card{3, 3};
  for (int move = 0; move < 2; ++move) {
    for (std::size_t i = 3; i < 6; ++i) scene.vertices[i].position.x += 0.05f;
    renderer.updateVertices(scene, std::span(&card, 1));
  }
  const testing::Frame moved = drawWith(renderer, camera_, settings_, kWidth, kHeight);
  EXPECT_NEAR(moved.at(kWidth / 2, kHeight / 2, "motion.X"), 0.1 * scale(3), 1e-3);
}

TEST_F(MotionTest, AMovedCameraMovesWhatIsNearMore) {
  const Scene scene = wallAndCard();
  Renderer renderer = makeRenderer(scene);
  drawWith(renderer, camera_, settings_, kWidth, kHeight);
  const testing::Frame moved = drawWith(renderer, lookAt({0.1f, 0, 4}, {0.1f, 0, 0}), settings_, kWidth, kHeight);
  EXPECT_NEAR(moved.at(kWidth / 2, kHeight / 2, "motion.X"), -0.1 * scale(3), 1e-3);
  EXPECT_NEAR(moved.at(5, kHeight - 5, "motion.X"), -0.1 * scale(4), 1e-3);
}

TEST_F(MotionTest, TheSkyTurnsWithTheCameraAlone) {
  Scene scene = wallAndCard();
  scene.triangles.erase(scene.triangles.begin());
  Renderer renderer = makeRenderer(scene);
  drawWith(renderer, camera_, settings_, kWidth, kHeight);
  const testing::Frame shifted = drawWith(renderer, lookAt({0.5f, 0, 4}, {0.5f, 0, 0}), settings_, kWidth, kHeight);
  EXPECT_EQ(shifted.at(2, 2, "depth.Z"), 0);
  EXPECT_NEAR(shifted.at(2, 2, "motion.X"), 0, 1e-3);
  const double angle = 0.02;
  const testing::Frame turned =
      drawWith(renderer, lookAt({0.5f, 0, 4}, {0.5f + 4 * static_cast<float>(std::tan(angle)), 0, 0}), settings_,
               kWidth, kHeight);
  // The pixel's direction, seen by the camera before it turned.
  const double x = (2 * 2 + 1 - kWidth) * 0.5 / scale(1), now = std::atan(x);
  const double y = (kHeight - 5) * 0.5 / scale(1);
  const double length = std::hypot(x, 1.0), before = std::tan(now + angle);
  EXPECT_NEAR(turned.at(2, 2, "motion.X"), (x - before) * scale(1), 2e-3);
  EXPECT_NEAR(turned.at(2, 2, "motion.Y"), -(y - y / length / std::cos(now + angle)) * scale(1), 2e-3);
}

}  // namespace
}  // namespace halfsilver
