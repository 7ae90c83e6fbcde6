#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "apps/demo/game/autopilot.h"
#include "apps/demo/game/game.h"
#include "apps/demo/game/recording.h"
#include "apps/demo/play.h"

namespace halfsilver::demo {

// Where the game's input comes from beside the player, and where it goes.
struct GameInputs {
  std::optional<Recording> replay;  // in place of the player
  bool autopilot = false;           // in place of the player
  std::string record;               // a file for all input; empty: none
};

// The game in the window: the player's Controls become one Input per fixed step.
class GamePlay final : public Play {
 public:
  GamePlay(Model model, GameInputs inputs)
      : game_(std::move(model)), bounds_(animatedBounds(game_.model())), inputs_(std::move(inputs)) {}

  Model& model() override { return game_.model(); }
  const AnimatedBounds& bounds() const override { return bounds_; }
  void step(const Controls& controls, double seconds) override;
  SceneChange takeChange() override { return game_.takeChange(); }
  const PoseState& poseState() const override { return game_.poseState(); }
  Camera camera() const override { return game_.camera(); }
  std::vector<std::string> status() const override;
  void finish() override;

  double bestSeconds = 0;  // of rounds that the player finished himself; 0: none

 private:
  void collect(const Controls& controls);
  Input next();

  Game game_;
  AnimatedBounds bounds_;
  GameInputs inputs_;
  Autopilot autopilot_;
  Recording recorded_;
  std::size_t replayed_ = 0;
  double time_ = 0;  // seconds that no step has used yet
  // What the player did since the last step.
  glm::vec2 move_{0}, look_{0}, turn_{0};  // look: degrees
  std::uint16_t buttons_ = 0;
};

}  // namespace halfsilver::demo
