#include "apps/demo/gamepad.h"

#include <GLFW/glfw3.h>

#include <algorithm>

namespace halfsilver::demo {
namespace {

constexpr float kDeadZone = 0.15f;  // of a stick or a pair of triggers

glm::vec2 withDeadZone(const glm::vec2& value) {
  const float length = glm::length(value);
  return length < kDeadZone ? glm::vec2(0) : value * std::min(1.0f, (length - kDeadZone) / (1 - kDeadZone)) / length;
}

}  // namespace

void Gamepad::read(const StateOf& stateOf, Controls& controls) {
  GLFWgamepadstate state{};
  connected_ = false;
  for (int joystick = GLFW_JOYSTICK_1; joystick <= GLFW_JOYSTICK_LAST && !connected_; ++joystick)
    connected_ = stateOf(joystick, &state) != 0;
  if (!connected_) state = {};
  const auto stick = [&](int x, int y) { return withDeadZone({state.axes[x], -state.axes[y]}); };
  const glm::vec2 left = stick(GLFW_GAMEPAD_AXIS_LEFT_X, GLFW_GAMEPAD_AXIS_LEFT_Y);
  // Triggers rest at -1, and at 0 if the mapping has none: their difference is 0 then, too.
  const float up = 0.5f * (state.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER] - state.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER]);
  const glm::vec3 move(left.x, withDeadZone({up, 0}).x, left.y);
  controls.move = glm::clamp(controls.move + move, -1.0f, 1.0f);
  controls.turn = stick(GLFW_GAMEPAD_AXIS_RIGHT_X, GLFW_GAMEPAD_AXIS_RIGHT_Y);

  const std::bitset<16> before = held_;
  for (std::size_t button = 0; button < std::size(state.buttons); ++button)
    held_[button] = state.buttons[button] == GLFW_PRESS;
  const auto press = [&](std::size_t button, bool& control) {
    control = control || (held_[button] && !before[button]);
  };
  press(GLFW_GAMEPAD_BUTTON_A, controls.action);
  press(GLFW_GAMEPAD_BUTTON_START, controls.restart);
  press(GLFW_GAMEPAD_BUTTON_Y, controls.reset);
  press(GLFW_GAMEPAD_BUTTON_X, controls.daylight);
  for (std::size_t i = 0; i < std::size(controls.lanterns); ++i)
    press(GLFW_GAMEPAD_BUTTON_DPAD_UP + i, controls.lanterns[i]);
}

}  // namespace halfsilver::demo
