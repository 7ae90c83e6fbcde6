#include "frame/frame_constants.h"

#include <gtest/gtest.h>

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
    EXPECT_NEAR(frame.minDistance, 1e-5f * bounds.diagonal(), 1e-9f);
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
