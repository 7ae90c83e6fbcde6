#pragma once

#include <cstddef>

#include "apps/demo/game/game.h"

// Plays the game by itself along the level's route: waits for platforms, rolls on and off them, and goes around again
// for what it missed. It steers as a player does, through Input.
namespace halfsilver::demo {

class Autopilot {
 public:
  Input next(const Game& game);

 private:
  struct Goal {
    glm::dvec3 position{0}, velocity{0};
    bool moves = false;  // it is on a platform
  };
  Goal goal(const Game& game, std::size_t index) const;
  Input steer(const Game& game, const Goal& goal, double speed) const;

  std::size_t next_ = 0;        // point of the route that it goes to
  bool aboard_ = false;         // it has begun the way to that point
  int stillSteps_ = 0;          // for how long the platform of that way has stood
  int steps_ = 0;               // on the way to that point
  glm::dvec3 lastPosition_{0};  // of the platform
};

}  // namespace halfsilver::demo
