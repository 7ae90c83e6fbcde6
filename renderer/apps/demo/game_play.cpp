#include "apps/demo/game_play.h"

#include <cmath>
#include <cstdio>
#include <iterator>

namespace halfsilver::demo {
namespace {

constexpr float kDegreesPerPixel = 0.22f;
constexpr float kDegreesPerSecond = 160;  // of a gamepad's stick

std::string clock(double seconds) {
  char text[32];
  const int tenths = static_cast<int>(std::lround(10 * seconds));
  std::snprintf(text, sizeof(text), "%d:%02d.%d", tenths / 600, tenths / 10 % 60, tenths % 10);
  return text;
}

}  // namespace

void GamePlay::collect(const Controls& controls) {
  move_ = {controls.move.x, controls.move.z};
  turn_ = controls.turn;
  look_ += kDegreesPerPixel * glm::vec2(1, -1) * (controls.orbit + controls.look);
  const auto press = [this](bool pressed, unsigned button) {
    if (pressed) buttons_ = static_cast<std::uint16_t>(buttons_ | button);
  };
  press(controls.action, kButtonStart);
  press(controls.restart, kButtonRestart);
  press(controls.reset, kButtonReset);
  press(controls.daylight, kButtonDaylight);
  for (std::size_t i = 0; i < std::size(controls.lanterns); ++i) press(controls.lanterns[i], kButtonLantern1 << i);
}

Input GamePlay::next() {
  if (inputs_.replay) return replayed_ < inputs_.replay->inputs.size() ? inputs_.replay->inputs[replayed_++] : Input{};
  if (inputs_.autopilot) return autopilot_.next(game_);
  const glm::vec2 look = look_ + turn_ * kDegreesPerSecond * static_cast<float>(kStepSeconds);
  const auto exact = [](float value) { return static_cast<double>(value); };
  const Input input = Input::of(exact(move_.x), exact(move_.y), exact(look.x), exact(look.y), buttons_);
  look_ = glm::vec2(0);
  buttons_ = 0;
  return input;
}

void GamePlay::step(const Controls& controls, double seconds) {
  collect(controls);
  constexpr double kRounding = 1e-9;
  for (time_ += seconds; time_ > kStepSeconds - kRounding; time_ -= kStepSeconds) {
    const Input input = next();
    if (!inputs_.record.empty()) recorded_.inputs.push_back(input);
    game_.step(input);
    const bool own = !inputs_.replay && !inputs_.autopilot;
    for (const Event event : game_.events())
      if (event == Event::finished && own && (bestSeconds <= 0 || game_.hud().seconds < bestSeconds))
        bestSeconds = game_.hud().seconds;
  }
}

std::vector<std::string> GamePlay::status() const {
  const Hud hud = game_.hud();
  std::string line =
      clock(hud.seconds) + "   " + std::to_string(hud.collected) + " of " + std::to_string(hud.total) + " stones";
  if (bestSeconds > 0) line += "   best " + clock(bestSeconds);
  switch (hud.phase) {
    case Phase::title:
      return {line, hud.message, "W A S D rolls the ball, the mouse turns the view"};
    case Phase::playing:
      break;
    case Phase::finished:
      return {line, hud.message + " in " + clock(hud.seconds), "Enter begins another"};
  }
  return hud.message.empty() ? std::vector{line} : std::vector{line, hud.message};
}

void GamePlay::finish() {
  if (!inputs_.record.empty()) writeRecording(inputs_.record, recorded_);
}

}  // namespace halfsilver::demo
