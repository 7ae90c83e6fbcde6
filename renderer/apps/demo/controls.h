#pragma once

#include <glm/glm.hpp>

namespace halfsilver::demo {

// What the player did since the last frame. Pixels are those of the window, from its upper left corner.
struct Controls {
  glm::vec2 pointer{-1};                        // outside: negative
  glm::vec2 orbit{0}, pan{0}, look{0};          // pixels dragged with the left, middle and right button
  float wheel = 0;                              // notches, away from the player
  bool clicked = false, doubleClicked = false;  // with the left button, without a drag
  bool flying = false;                          // the right button is held
  glm::vec3 move{0};                            // right, up, forward, -1..1: keys or a gamepad's left stick
  glm::vec2 turn{0};                            // right, up, -1..1: a gamepad's right stick
  bool action = false, restart = false;         // pressed in this frame, as the following
  bool reset = false, daylight = false, lanterns[4] = {};
};

}  // namespace halfsilver::demo
