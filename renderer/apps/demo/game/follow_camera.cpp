#include "apps/demo/game/follow_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/demo/game/input.h"

namespace halfsilver::demo {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kDistance = 3.3, kPivotHeight = 0.45;
constexpr double kMinPitch = -0.15, kMaxPitch = 1.25;

}  // namespace

void Spring::follow(const dvec3& goal, double settle, double seconds) {
  const double rate = 2 / settle;
  const double decay = std::exp(-rate * seconds);
  const dvec3 offset = value - goal, change = (speed + rate * offset) * seconds;
  speed = (speed - rate * change) * decay;
  value = goal + (offset + change) * decay;
}

FollowCamera::FollowCamera(const dvec3& ball, double yaw) : yaw_(yaw), distance_(kDistance) {
  pivot_.value = ball + dvec3(0, kPivotHeight, 0);
  step({}, ball, dvec3(0), dvec2(0));
}

dvec2 FollowCamera::ahead() const { return {std::sin(yaw_), -std::cos(yaw_)}; }

void FollowCamera::step(const TriangleGrid& ground, const dvec3& ball, const dvec3& velocity, const dvec2& look) {
  yaw_ += look.x;
  pitch_ = std::clamp(pitch_ - look.y, kMinPitch, kMaxPitch);
  idleSeconds_ = look == dvec2(0) ? idleSeconds_ + kStepSeconds : 0;
  const double speed = std::hypot(velocity.x, velocity.z);
  if (idleSeconds_ > 0.8 && speed > 0.3) {
    // Turns after the ball, slowest for one that comes straight at it.
    const double wanted = std::atan2(velocity.x, -velocity.z);
    const double off = std::remainder(wanted - yaw_, 2 * std::numbers::pi);
    yaw_ += off * 0.5 * (1 + std::cos(off)) * std::min(speed / 3, 1.0) * 1.6 * kStepSeconds;
  }
  pivot_.follow(ball + dvec3(0, kPivotHeight, 0), 0.12, kStepSeconds);

  // The sphere starts in the ball, which is never in a wall, goes to the pivot and back from there.
  const dvec3 toPivot = pivot_.value - ball;
  target_ = ball + toPivot * ground.cast(ball, toPivot, kRadius);
  const dvec2 forward = ahead();
  const dvec3 back(-forward.x * std::cos(pitch_), std::sin(pitch_), -forward.y * std::cos(pitch_));
  const double room = kDistance * ground.cast(target_, back * kDistance, kRadius);
  distance_ = std::min(room, distance_ + (kDistance - distance_) * 2.5 * kStepSeconds);
  eye_ = target_ + back * std::max(distance_, 0.05);
}

Camera FollowCamera::camera() const {
  Camera camera;
  camera.name = "player";
  camera.eye = glm::vec3(eye_);
  camera.target = glm::vec3(target_);
  camera.verticalFov = 0.96f;
  camera.nearPlane = 0.05f;
  camera.farPlane = 60;
  return camera;
}

}  // namespace halfsilver::demo
