#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <halfsilver/pose.h>
#include "apps/demo/game/follow_camera.h"
#include "apps/demo/game/input.h"
#include "apps/demo/game/level.h"
#include "apps/demo/game/rules.h"
#include "apps/demo/game/world.h"

// The whole game without a window: inputs go in, a pose, a camera and changed lights come out. The same inputs from the
// beginning give the same state after every step.
//
//   Game game(makeBuiltin("game"));
//   renderer.setModel(game.model());
//   per frame:  game.step(input) for each kStepSeconds that passed;
//               renderer.pose(game.poseState());
//               if (const SceneChange change = game.takeChange(); change.any()) renderer.update(game.model().scene,
//               change); renderer.render(game.camera(), ...);
namespace halfsilver::demo {

struct Hud {
  Phase phase = Phase::title;
  double seconds = 0;
  int collected = 0, total = 0;
  bool goalOpen = false;
  double speed = 0;            // m/s
  std::vector<bool> lanterns;  // which are lit
  bool daylight = true;
  std::string message;  // one line for the player; may be empty
};

class Game {
 public:
  // Throws Error (badInput) if the model is no level.
  explicit Game(Model model);

  void step(const Input& input);

  // As it was given, but for lights, the sky and values of materials: those are as they are now. Vertices are as the
  // caller poses them.
  const Model& model() const { return model_; }
  Model& model() { return model_; }  // for who poses it or edits lights and materials
  const PoseState& poseState() const { return state_; }
  Camera camera() const { return camera_.camera(); }
  // What changed of lights, sky and materials since the last call.
  SceneChange takeChange();
  Hud hud() const;
  std::span<const Event> events() const { return events_; }  // of the last step

  const Level& level() const { return level_; }
  const World& world() const { return world_; }
  const Rules& rules() const { return rules_; }
  const FollowCamera& follower() const { return camera_; }
  std::uint64_t steps() const { return steps_; }

 private:
  void beginRound();
  void press(std::uint16_t pressed);
  void switchLantern(std::size_t lantern);
  void switchDaylight();
  void placeNodes();
  void moveBodies(const PoseState& before, int substep);
  glm::dvec3 positionOf(int node) const { return state_.world[static_cast<std::size_t>(node)][3]; }

  Model model_;
  std::vector<Node> nodes_;  // as the level sets them up, and so on
  std::vector<Light> lights_;
  std::vector<Material> materials_;
  Sky sky_;
  Level level_;
  World world_;
  FollowCamera camera_;
  Rules rules_;
  PoseState state_;
  std::vector<MovingBody> bodies_;
  std::vector<Pillar> pillars_;
  std::vector<bool> lanterns_, onPlate_;
  bool daylight_ = true;
  SceneChange change_;
  std::vector<Event> events_;
  std::uint16_t held_ = 0;
  std::uint64_t steps_ = 0, roundSteps_ = 0;
};

}  // namespace halfsilver::demo
