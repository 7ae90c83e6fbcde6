#include "apps/demo/viewer_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace halfsilver::demo {
namespace {

constexpr float kRadiansPerPixel = 0.005f;
constexpr float kZoomPerNotch = 0.88f;
constexpr float kSpeedPerNotch = 1.25f;
constexpr float kHighestPitch = 1.55f;  // radians; straight up has no right side
constexpr float kTurnSpeed = 2;         // radians per second of a full stick

}  // namespace

ViewerCamera::ViewerCamera(const Camera& start, const Bounds& bounds) : camera_(start) {
  const glm::vec3 towards = start.target - start.eye;
  const glm::vec3 from = -glm::normalize(towards);
  yaw_ = std::atan2(from.x, from.z);
  pitch_ = std::clamp(std::asin(std::clamp(from.y, -1.0f, 1.0f)), -kHighestPitch, kHighestPitch);
  distance_ = glm::length(towards);
  pivot_ = start.target;
  speed_ = bounds.empty() || !(bounds.diagonal() > 0) ? 1.0f : 0.2f * bounds.diagonal();
  camera_.name = "viewer";
  camera_.parallelHeight = 0;  // one flies through the scene
  camera_.up = {0, 1, 0};
}

glm::vec3 ViewerCamera::back() const {
  return {std::sin(yaw_) * std::cos(pitch_), std::sin(pitch_), std::cos(yaw_) * std::cos(pitch_)};
}

glm::vec3 ViewerCamera::right() const { return {std::cos(yaw_), 0, -std::sin(yaw_)}; }

void ViewerCamera::follow(const Controls& controls, double seconds, int windowHeight) {
  const auto turn = [&](const glm::vec2& pixels) {
    yaw_ -= kRadiansPerPixel * pixels.x;
    pitch_ = std::clamp(pitch_ + kRadiansPerPixel * pixels.y, -kHighestPitch, kHighestPitch);
  };
  const auto elapsed = static_cast<float>(seconds);
  turn(controls.orbit);
  // Looking around keeps the eye where it is: the pivot turns about it.
  const glm::vec3 eye = pivot_ + distance_ * back();
  turn(controls.look);
  const glm::vec2 stick = controls.turn * (kTurnSpeed * elapsed / kRadiansPerPixel);
  turn({stick.x, -stick.y});
  if (controls.look != glm::vec2(0) || controls.turn != glm::vec2(0)) pivot_ = eye - distance_ * back();

  const glm::vec3 up = glm::cross(back(), right());
  // What is under the pointer at the pivot's distance stays under it.
  const float meters =
      2 * distance_ * std::tan(0.5f * camera_.verticalFov) / static_cast<float>(std::max(1, windowHeight));
  pivot_ += meters * (-controls.pan.x * right() + controls.pan.y * up);
  if (controls.flying)
    speed_ *= std::pow(kSpeedPerNotch, controls.wheel);
  else
    distance_ *= std::pow(kZoomPerNotch, controls.wheel);
  pivot_ += speed_ * elapsed * (controls.move.x * right() + controls.move.y * up - controls.move.z * back());
}

void ViewerCamera::setPivot(const glm::vec3& pivot) {
  const glm::vec3 from = pivot_ + distance_ * back() - pivot;
  const float length = glm::length(from);
  if (!(length > 0)) return;
  pivot_ = pivot;
  distance_ = length;
  yaw_ = std::atan2(from.x, from.z);
  pitch_ = std::clamp(std::asin(std::clamp(from.y / length, -1.0f, 1.0f)), -kHighestPitch, kHighestPitch);
}

void ViewerCamera::frame(const Bounds& bounds) {
  if (bounds.empty()) return;
  pivot_ = bounds.center();
  if (!(bounds.diagonal() > 0)) return;
  distance_ = 0.5f * bounds.diagonal() / std::sin(0.5f * camera_.verticalFov);
}

Camera ViewerCamera::camera() const {
  Camera camera = camera_;
  camera.eye = pivot_ + distance_ * back();
  camera.target = pivot_;
  return camera;
}

}  // namespace halfsilver::demo
