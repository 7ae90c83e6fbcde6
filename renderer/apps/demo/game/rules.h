#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "apps/demo/game/input.h"

// What a round is: from the start, all items, then the goal, against the clock.
namespace halfsilver::demo {

enum class Phase { title, playing, finished };
enum class Event { started, collected, goalOpened, finished, switchedLantern, switchedDaylight, returned };

class Rules {
 public:
  explicit Rules(std::size_t items) : collectedAt_(items, -1) {}

  // What the ball reaches in a step.
  struct Places {
    glm::dvec3 ball{0};
    std::span<const glm::dvec3> items;
    glm::dvec3 goal{0};
  };
  // One step; `pressed` are the buttons that went down in it. Appends what happened. Returns whether a new round
  // begins, for which everything goes back to its place.
  bool step(const Input& input, std::uint16_t pressed, const Places& places, std::vector<Event>& events);

  Phase phase() const { return phase_; }
  double seconds() const { return static_cast<double>(steps_) * kStepSeconds; }  // of the round; stands at its end
  int collected() const;
  int total() const { return static_cast<int>(collectedAt_.size()); }
  bool goalOpen() const { return openedAt_ >= 0; }
  double sinceCollected(std::size_t item) const;  // seconds; negative: it is still there
  double sinceOpened() const;                     // seconds; negative: the goal is closed

 private:
  double since(std::int64_t step) const { return step < 0 ? -1 : static_cast<double>(now_ - step) * kStepSeconds; }

  Phase phase_ = Phase::title;
  std::int64_t now_ = 0;  // steps since the round was set up
  std::int64_t steps_ = 0;
  std::vector<std::int64_t> collectedAt_;  // step, -1: not yet
  std::int64_t openedAt_ = -1;
};

}  // namespace halfsilver::demo
