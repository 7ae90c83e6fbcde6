// The body that a camera sees of the scene, and the map in light-space perspective that is laid over it.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <vector>

#include "passes/light_list.h"
#include "passes/visible_body.h"

namespace halfsilver {
namespace {

using glm::vec3;
using glm::vec4;

constexpr float kAspect = 16.0f / 9;
constexpr int kSize = 512, kMargin = 4;

const Bounds kRoom{vec3(-20, 0, -30), vec3(20, 15, 30)};

Camera inTheRoom() {
  Camera camera;
  camera.eye = {1, 1.7f, 25};
  camera.target = {0, 3, 0};
  camera.verticalFov = glm::radians(50.0f);
  return camera;
}

bool seenBy(const Camera& camera, const vec3& point) {
  const vec4 clip = glm::perspective(camera.verticalFov, kAspect, 1e-3f, 1e3f) *
                    glm::lookAt(camera.eye, camera.target, camera.up) * vec4(point, 1);
  return clip.w > 0 && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w;
}

std::vector<vec3> seenPoints(const Camera& camera, const Bounds& bounds) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> share(0, 1);
  std::vector<vec3> points;
  while (points.size() < 2000) {
    const vec3 point = bounds.low + bounds.extent() * vec3(share(random), share(random), share(random));
    if (seenBy(camera, point)) points.push_back(point);
  }
  return points;
}

vec3 place(const glm::mat4& worldToClip, const vec3& point) {
  const vec4 clip = worldToClip * vec4(point, 1);
  return clip.w > 0 ? vec3(clip) / clip.w : vec3(9);
}

TEST(VisibleBody, HasItsCornersInTheSceneAndInTheView) {
  const VisibleBody body = visibleBody(inTheRoom(), kAspect, kRoom);
  ASSERT_GE(body.corners.size(), 8u);
  Camera wider = inTheRoom();
  wider.verticalFov *= 1.001f;
  for (const vec3& corner : body.corners) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(corner[axis], kRoom.low[axis] - 1e-4f);
      EXPECT_LE(corner[axis], kRoom.high[axis] + 1e-4f);
    }
    EXPECT_TRUE(glm::distance(corner, body.eye) < 1e-4f || seenBy(wider, corner))
        << corner.x << ' ' << corner.y << ' ' << corner.z;
  }
  EXPECT_TRUE(visibleBody(inTheRoom(), kAspect, {}).corners.empty());
}

TEST(VisibleBody, IsThatOfTheViewIfTheCameraLooksStraightDown) {
  Camera camera = inTheRoom();
  camera.eye = {0, 10, 0};
  camera.target = {0, 0, 0};
  const VisibleBody body = visibleBody(camera, kAspect, kRoom);
  ASSERT_FALSE(body.corners.empty());
  for (const vec3& corner : body.corners) {
    EXPECT_LE(corner.y, 10.001f) << "nothing behind the eye";
    EXPECT_LE(std::abs(corner.x), kAspect * std::tan(glm::radians(25.0f)) * 10.01f);
  }
}

TEST(VisibleBody, IsNothingBehindTheCameraOrInAParallelView) {
  Camera camera = inTheRoom();
  camera.eye = {0, 3, 100};
  camera.target = {0, 3, 200};
  EXPECT_TRUE(visibleBody(camera, kAspect, kRoom).corners.empty());
  camera = inTheRoom();
  camera.parallelHeight = 10;
  EXPECT_TRUE(visibleBody(camera, kAspect, kRoom).corners.empty());
}

class LightSpace : public ::testing::TestWithParam<vec3> {
 protected:
  const Camera camera_ = inTheRoom();
  const VisibleBody body_ = visibleBody(camera_, kAspect, kRoom);
  const vec3 direction_ = glm::normalize(GetParam());
  const glm::mat4 map_ = fitLightSpace(kRoom, body_, direction_, kSize, kMargin);
};

TEST_P(LightSpace, ShowsAllThatTheCameraSeesAndWhatMayCastShadowsOnIt) {
  const float inner = 1 - 2.0f * kMargin / kSize + 1e-4f;
  for (const vec3& point : seenPoints(camera_, kRoom)) {
    const vec3 at = place(map_, point);
    EXPECT_LE(std::max(std::abs(at.x), std::abs(at.y)), inner);
    EXPECT_LE(std::abs(at.z), 1);
  }
}

TEST_P(LightSpace, KeepsLightParallel) {
  for (const vec3& point : seenPoints(camera_, kRoom)) {
    const vec3 nearer = place(map_, point - 0.5f * direction_), farther = place(map_, point + 0.5f * direction_);
    EXPECT_NEAR(nearer.x, farther.x, 1e-4f);
    EXPECT_NEAR(nearer.y, farther.y, 1e-4f);
    EXPECT_LT(nearer.z, farther.z);
  }
}

// Texels per meter across the light, near the eye over far away.
double gain(const glm::mat4& map, const VisibleBody& body, const vec3& direction) {
  const vec3 across = glm::normalize(glm::cross(direction, body.forward));
  const auto fineness = [&](float distance) {
    const vec3 at = body.eye + distance * body.forward;
    return static_cast<double>(glm::distance(place(map, at), place(map, at + 0.05f * across)));
  };
  return fineness(1) / fineness(40);
}

TEST(LightSpace, IsFinerNearTheEyeIfTheLightComesFromTheSide) {
  const VisibleBody body = visibleBody(inTheRoom(), kAspect, kRoom);
  const vec3 side = glm::normalize(vec3(0.2f, -1, 0.1f)), along = body.forward;
  EXPECT_GT(gain(fitLightSpace(kRoom, body, side, kSize, kMargin), body, side), 3);
  const vec3 across = glm::normalize(glm::cross(along, vec3(0, 1, 0)));
  const glm::mat4 dueling = fitLightSpace(kRoom, body, along, kSize, kMargin);
  const auto fineness = [&](float distance) {
    const vec3 at = body.eye + distance * along;
    return glm::distance(place(dueling, at), place(dueling, at + 0.05f * across));
  };
  EXPECT_NEAR(fineness(1), fineness(40), 0.02f * fineness(1)) << "along the view there is nothing to gain";
}

INSTANTIATE_TEST_SUITE_P(From, LightSpace,
                         ::testing::Values(vec3(0.2f, -1, 0.1f), vec3(-1, -0.3f, 0.4f), vec3(0, -0.1f, -1),
                                           vec3(0.1f, -0.2f, 1), vec3(0, -1, 0)));

TEST(LightSpace, IsADirectionalLightsFirstMapAndGoesIfThereIsNoRoom) {
  Light sun;
  sun.type = LightType::directional;
  sun.direction = {0.2f, -1, 0.1f};
  ShadowBoxes boxes;
  boxes.seen = visibleBody(inTheRoom(), kAspect, kRoom);
  boxes.around = {Bounds{vec3(-1), vec3(1)}};
  LightListLimits limits;
  limits.resolution = kSize;
  limits.skyDirections = 0;
  Sky sky;
  LightList list = makeLightList(kRoom, {&sun, 1}, sky, limits, boxes);
  ASSERT_EQ(list.views.size(), 2u) << "that of all follows, none around the eye";
  EXPECT_NE(list.views[0].worldToClip[2][3], 0.0f);
  EXPECT_EQ(list.views[1].worldToClip[3][3], 1.0f);
  limits.layers = 1;
  list = makeLightList(kRoom, {&sun, 1}, sky, limits, boxes);
  ASSERT_EQ(list.views.size(), 1u);
  EXPECT_EQ(list.views[0].worldToClip[2][3], 0.0f);
  EXPECT_EQ(list.warnings.size(), 1u);
}

}  // namespace
}  // namespace halfsilver
