#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace halfsilver::demo {

inline constexpr int kStepsPerSecond = 60;
inline constexpr double kStepSeconds = 1.0 / kStepsPerSecond;

enum Button : std::uint16_t {
  kButtonStart = 1,     // begins a round, from the title or after its end
  kButtonRestart = 2,   // begins a new round at any time
  kButtonReset = 4,     // puts the ball back to the last safe place
  kButtonLantern1 = 8,  // switches a lantern; the next three bits are the other lanterns
  kButtonDaylight = 128
};

// What the player does in one step, in whole numbers, so that a recording is exact.
struct Input {
  std::int8_t moveX = 0, moveY = 0;   // right and ahead of the camera, in 1/127
  std::int16_t lookX = 0, lookY = 0;  // by which the camera turns right and up, in 1/100 degree
  std::uint16_t buttons = 0;          // those held; a press counts once

  static Input of(double right, double ahead, double lookDegreesX = 0, double lookDegreesY = 0,
                  std::uint16_t buttons = 0) {
    const auto whole = [](double value, double scale, double limit) {
      return std::isfinite(value) ? std::clamp(std::round(value * scale), -limit, limit) : 0.0;
    };
    return {static_cast<std::int8_t>(whole(right, 127, 127)), static_cast<std::int8_t>(whole(ahead, 127, 127)),
            static_cast<std::int16_t>(whole(lookDegreesX, 100, 32767)),
            static_cast<std::int16_t>(whole(lookDegreesY, 100, 32767)), buttons};
  }
  bool operator==(const Input&) const = default;
};

}  // namespace halfsilver::demo
