#include "frame/frame_constants.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include <halfsilver/error.h>

namespace halfsilver {
namespace {

TEST(FrameConstants, PixelRaysAgreeWithTheProjection) {
  Camera camera;
  camera.eye = {1, 2, 3};
  camera.target = {-4, 1, 0};
  for (const float farPlane : {0.0f, 20.0f}) {
    camera.farPlane = farPlane;
    const Bounds bounds{{-10, -10, -10}, {10, 10, 10}};
    const shared::FrameConstants frame = makeFrameConstants(camera, bounds, {}, {}, 200, 100, {});
    const glm::vec3 point = camera.eye + 5.0f * (frame.forward + 0.3f * frame.right - 0.6f * frame.up);
    const glm::vec4 clip = frame.viewProjection * glm::vec4(point, 1);
    EXPECT_NEAR(clip.x / clip.w, 0.3f, 1e-5f);
    EXPECT_NEAR(clip.y / clip.w, -0.6f, 1e-5f);
    EXPECT_NEAR(clip.w, 5.0f, 1e-5f);
    const float nearPlane = frame.nearPlane;
    EXPECT_GT(nearPlane, 0);
    const glm::vec4 nearest = frame.viewProjection * glm::vec4(camera.eye + nearPlane * frame.forward, 1);
    EXPECT_NEAR(nearest.z / nearest.w, 1.0f, 1e-3f);
    if (farPlane > 0) {
      const glm::vec4 farthest = frame.viewProjection * glm::vec4(camera.eye + farPlane * frame.forward, 1);
      EXPECT_NEAR(farthest.z / nearPlane, 0.0f, 1e-3f);
    }
    EXPECT_NEAR(glm::length(frame.right) / glm::length(frame.up), 2.0f, 1e-6f);
    EXPECT_FLOAT_EQ(frame.minDistance, 10 * 0x1p-20f);
  }
}

TEST(FrameConstants, TheProjectionBringsSamplesToPixelCenters) {
  Camera camera;
  camera.eye = {1, 2, 3};
  camera.target = {-4, 1, 0};
  const glm::vec2 jitter(0.3f, -0.4f), size(200, 100), center(0.3f, -0.6f);
  const shared::FrameConstants frame =
      makeFrameConstants(camera, {{-10, -10, -10}, {10, 10, 10}}, {}, {}, 200, 100, {}, jitter);
  const glm::vec2 sample = center + 2.0f * jitter / size;
  const glm::vec3 point = camera.eye + 5.0f * (frame.forward + sample.x * frame.right + sample.y * frame.up);
  const glm::vec4 clip = frame.viewProjection * glm::vec4(point, 1);
  EXPECT_NEAR(clip.x / clip.w, center.x, 1e-5f);
  EXPECT_NEAR(clip.y / clip.w, center.y, 1e-5f);
  EXPECT_EQ(frame.jitter, jitter);
}

TEST(SampleOffset, BeginsAtTheCenterAndFillsThePixelEvenly) {
  EXPECT_EQ(sampleOffset(0), glm::vec2(0));
  // Of 64 samples, each sixteenth of the pixel holds 4.
  std::array<int, 16> counts{};
  for (std::uint32_t i = 0; i < 64; ++i) {
    const glm::vec2 at = sampleOffset(i) + 0.5f;
    ASSERT_TRUE(at.x >= 0 && at.x < 1 && at.y >= 0 && at.y < 1) << i;
    ++counts[static_cast<std::size_t>(at.x * 4) + 4 * static_cast<std::size_t>(at.y * 4)];
  }
  for (const int count : counts) EXPECT_EQ(count, 4);
}

TEST(MeanMotion, IsHowFarThingsAtTheTargetMoveOnTheScreen) {
  const glm::ivec2 size(200, 100);
  Camera before;
  before.eye = {1, 2, 3};
  before.target = {1, 2, -1};
  before.verticalFov = glm::radians(50.0f);
  EXPECT_LT(glm::length(meanMotion(before, before, size)), 1e-12);
  const float pixel = 2 * 4 * std::tan(0.5f * before.verticalFov) / 100;
  Camera now = before;
  now.eye += glm::vec3(0.5f, -2, 0) * pixel;
  now.target += glm::vec3(0.5f, -2, 0) * pixel;
  EXPECT_LT(glm::length(meanMotion(before, now, size) - glm::dvec2(-0.5, 2)), 1e-4);
  before.parallelHeight = now.parallelHeight = 100 * pixel;
  EXPECT_LT(glm::length(meanMotion(before, now, size) - glm::dvec2(-0.5, 2)), 1e-4);
  before.parallelHeight = now.parallelHeight = 0;
  // A turn moves what is seen aside a little more than the middle.
  now = before;
  now.target.x += pixel;
  const double turn = meanMotion(before, now, size).x;
  EXPECT_LT(turn, -1.2);
  EXPECT_GT(turn, -1.4);
  now.target = {1, 2, 7};
  EXPECT_EQ(meanMotion(before, now, size), glm::dvec2(0)) << "nothing is in both";
}

// Otherwise few samples show a picture that is moved.
TEST(SampleOffset, TheMeanOfTheFirstFewIsTheCenter) {
  glm::dvec2 sum(0);
  for (std::uint32_t count = 1; count <= 4096; ++count) {
    const glm::vec2 at = sampleOffset(count - 1);
    sum += glm::dvec2(at);
    EXPECT_LT(glm::length(sum), 1.0) << count;
    if (count < 4 || (count & (count - 1)) != 0) continue;
    EXPECT_LT(glm::length(sum / static_cast<double>(count)), 1e-3) << count;
  }
}

TEST(FrameConstants, LookingStraightDownWorksAndNonsenseIsRefused) {
  Camera camera;
  camera.eye = {0, 5, 0};
  const shared::FrameConstants frame = makeFrameConstants(camera, {}, {}, {}, 10, 10, {});
  EXPECT_NEAR(glm::dot(frame.right, glm::vec3(0, 1, 0)), 0, 1e-6f);
  EXPECT_GT(glm::length(frame.up), 0.1f);
  EXPECT_THROW(makeFrameConstants(camera, {}, {}, {}, 0, 10, {}), Error);
  camera.target = camera.eye;
  EXPECT_THROW(makeFrameConstants(camera, {}, {}, {}, 10, 10, {}), Error);
}

}  // namespace
}  // namespace halfsilver
