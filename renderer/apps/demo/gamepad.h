#pragma once

#include <bitset>
#include <functional>

#include "apps/demo/controls.h"

struct GLFWgamepadstate;

namespace halfsilver::demo {

// A gamepad's part of the player's controls, with the buttons and sticks of GLFW's mappings.
class Gamepad {
 public:
  // As glfwGetGamepadState(): false if there is no such joystick or no mapping of it.
  using StateOf = std::function<int(int joystick, GLFWgamepadstate* state)>;

  // Adds what the first gamepad does to what keys do. Pads may come and go between frames.
  void read(const StateOf& stateOf, Controls& controls);
  bool connected() const { return connected_; }  // at the last read()

 private:
  bool connected_ = false;
  std::bitset<16> held_;  // buttons, at the last read()
};

}  // namespace halfsilver::demo
