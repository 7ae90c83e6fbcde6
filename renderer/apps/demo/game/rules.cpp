#include "apps/demo/game/rules.h"

#include <algorithm>

namespace halfsilver::demo {
namespace {

constexpr double kItemReach = 0.68;  // meters, from the ball's center
constexpr double kGoalReach = 0.85;  // meters, on the level
constexpr double kGoalHeight = 1.0;

}  // namespace

int Rules::collected() const {
  return static_cast<int>(std::count_if(collectedAt_.begin(), collectedAt_.end(), [](auto at) { return at >= 0; }));
}

double Rules::sinceCollected(std::size_t item) const { return since(collectedAt_[item]); }
double Rules::sinceOpened() const { return since(openedAt_); }

bool Rules::step(const Input& input, std::uint16_t pressed, const Places& places, std::vector<Event>& events) {
  const bool again = (pressed & kButtonRestart) || (phase_ == Phase::finished && (pressed & kButtonStart));
  if (again) *this = Rules(collectedAt_.size());
  const bool moves = input.moveX != 0 || input.moveY != 0;
  if (phase_ == Phase::title && (again || moves || (pressed & kButtonStart))) {
    phase_ = Phase::playing;
    events.push_back(Event::started);
  }
  ++now_;
  if (again || phase_ != Phase::playing) return again;
  ++steps_;
  for (std::size_t i = 0; i < collectedAt_.size(); ++i)
    if (collectedAt_[i] < 0 && glm::distance(places.ball, places.items[i]) < kItemReach) {
      collectedAt_[i] = now_;
      events.push_back(Event::collected);
    }
  if (openedAt_ < 0 && collected() == total()) {
    openedAt_ = now_;
    events.push_back(Event::goalOpened);
  }
  const glm::dvec3 toGoal = places.ball - places.goal;
  if (openedAt_ >= 0 && glm::length(glm::dvec2(toGoal.x, toGoal.z)) < kGoalReach && toGoal.y < kGoalHeight) {
    phase_ = Phase::finished;
    events.push_back(Event::finished);
  }
  return false;
}

}  // namespace halfsilver::demo
