#include <gtest/gtest.h>

#if HALFSILVER_DEMO

#include <GLFW/glfw3.h>

#include <map>

#include "apps/demo/gamepad.h"

namespace halfsilver::demo {
namespace {

GLFWgamepadstate resting() {
  GLFWgamepadstate state{};
  state.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER] = state.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER] = -1;
  return state;
}

// Gamepads by their numbers; other joysticks have no mapping.
struct Pads {
  std::map<int, GLFWgamepadstate> states;
  Gamepad gamepad;

  Controls read(Controls controls = {}) {
    gamepad.read(
        [this](int joystick, GLFWgamepadstate* state) {
          const auto found = states.find(joystick);
          if (found != states.end()) *state = found->second;
          return found != states.end() ? GLFW_TRUE : GLFW_FALSE;
        },
        controls);
    return controls;
  }
};

TEST(Gamepad, SticksMoveAndTurnFromTheirDeadZoneOn) {
  Pads pads{{{GLFW_JOYSTICK_1, resting()}}, {}};
  auto& axes = pads.states[GLFW_JOYSTICK_1].axes;
  axes[GLFW_GAMEPAD_AXIS_LEFT_X] = 0.1f;
  axes[GLFW_GAMEPAD_AXIS_RIGHT_Y] = -0.1f;
  EXPECT_EQ(pads.read().move, glm::vec3(0)) << "a stick that does not quite come back to its middle";
  EXPECT_EQ(pads.read().turn, glm::vec2(0));
  axes[GLFW_GAMEPAD_AXIS_LEFT_X] = 0.16f;
  EXPECT_GT(pads.read().move.x, 0);
  EXPECT_LT(pads.read().move.x, 0.02f) << "no jump at the edge";
  axes[GLFW_GAMEPAD_AXIS_LEFT_X] = -1;
  axes[GLFW_GAMEPAD_AXIS_LEFT_Y] = -1;
  axes[GLFW_GAMEPAD_AXIS_RIGHT_X] = 1;
  axes[GLFW_GAMEPAD_AXIS_RIGHT_Y] = 0;
  const Controls controls = pads.read();
  EXPECT_NEAR(glm::length(controls.move), 1, 1e-6f) << "corners are no faster";
  EXPECT_LT(controls.move.x, -0.7f);
  EXPECT_GT(controls.move.z, 0.7f) << "up is ahead";
  EXPECT_EQ(controls.turn, glm::vec2(1, 0));
}

TEST(Gamepad, TriggersMoveUpAndDown) {
  Pads pads{{{GLFW_JOYSTICK_1, resting()}}, {}};
  auto& axes = pads.states[GLFW_JOYSTICK_1].axes;
  EXPECT_EQ(pads.read().move.y, 0);
  axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER] = 1;
  EXPECT_EQ(pads.read().move.y, 1);
  axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER] = -1;
  axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER] = 1;
  EXPECT_EQ(pads.read().move.y, -1);
  axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER] = axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER] = 0;
  EXPECT_EQ(pads.read().move.y, 0) << "a pad without triggers";
}

TEST(Gamepad, AButtonThatIsHeldIsPressedOnce) {
  Pads pads{{{GLFW_JOYSTICK_1, resting()}}, {}};
  auto& buttons = pads.states[GLFW_JOYSTICK_1].buttons;
  const std::pair<int, bool Controls::*> meanings[] = {{GLFW_GAMEPAD_BUTTON_A, &Controls::action},
                                                       {GLFW_GAMEPAD_BUTTON_START, &Controls::restart},
                                                       {GLFW_GAMEPAD_BUTTON_Y, &Controls::reset},
                                                       {GLFW_GAMEPAD_BUTTON_X, &Controls::daylight}};
  for (const auto& [button, meaning] : meanings) {
    EXPECT_FALSE(pads.read().*meaning);
    buttons[button] = GLFW_PRESS;
    EXPECT_TRUE(pads.read().*meaning);
    EXPECT_FALSE(pads.read().*meaning) << "held";
    buttons[button] = GLFW_RELEASE;
    EXPECT_FALSE(pads.read().*meaning);
  }
  for (int i = 0; i < 4; ++i) {
    buttons[GLFW_GAMEPAD_BUTTON_DPAD_UP + i] = GLFW_PRESS;
    const Controls controls = pads.read();
    for (int lantern = 0; lantern < 4; ++lantern) EXPECT_EQ(controls.lanterns[lantern], lantern == i);
  }
}

TEST(Gamepad, PadsComeAndGoInPlay) {
  Pads pads;
  EXPECT_EQ(pads.read().move, glm::vec3(0));
  EXPECT_FALSE(pads.gamepad.connected()) << "none, or joysticks without a mapping";
  pads.states[GLFW_JOYSTICK_3] = resting();
  pads.states[GLFW_JOYSTICK_3].axes[GLFW_GAMEPAD_AXIS_LEFT_X] = 1;
  pads.states[GLFW_JOYSTICK_3].buttons[GLFW_GAMEPAD_BUTTON_A] = GLFW_PRESS;
  EXPECT_EQ(pads.read().move.x, 1) << "the first joystick with a mapping";
  EXPECT_TRUE(pads.gamepad.connected());
  pads.states[GLFW_JOYSTICK_2] = resting();
  EXPECT_EQ(pads.read().move.x, 0) << "of two pads the first plays";
  pads.states.erase(GLFW_JOYSTICK_2);
  EXPECT_EQ(pads.read().move.x, 1);
  pads.states.clear();
  const Controls controls = pads.read();
  EXPECT_EQ(controls.move, glm::vec3(0)) << "nothing stays held";
  EXPECT_FALSE(controls.action);
  EXPECT_FALSE(pads.gamepad.connected());
}

TEST(Gamepad, LeavesWhatKeysDo) {
  Pads pads;
  Controls keys;
  keys.move = {1, 0, -1};
  keys.action = true;
  EXPECT_EQ(pads.read(keys).move, keys.move);
  EXPECT_TRUE(pads.read(keys).action);
  pads.states[GLFW_JOYSTICK_1] = resting();
  pads.states[GLFW_JOYSTICK_1].axes[GLFW_GAMEPAD_AXIS_LEFT_X] = 1;
  EXPECT_EQ(pads.read(keys).move, keys.move) << "both together are no faster";
  EXPECT_TRUE(pads.read(keys).action);
}

}  // namespace
}  // namespace halfsilver::demo

#endif
