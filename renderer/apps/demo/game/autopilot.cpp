#include "apps/demo/game/autopilot.h"

#include <algorithm>
#include <cmath>

namespace halfsilver::demo {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kReached = 0.35;                 // meters, on the level
constexpr double kStep = 2.1, kClimb = 0.12;      // how far from a platform it starts, along and up
constexpr double kCruise = 3.4, kBoarding = 2.2;  // m/s
constexpr int kPatience = 45 * kStepsPerSecond;

}  // namespace

Autopilot::Goal Autopilot::goal(const Game& game, std::size_t index) const {
  const auto node = static_cast<std::size_t>(game.level().route[index]);
  const bool moves = game.model().rig.nodes[node].parent >= 0;
  return {game.poseState().world[node][3], dvec3(0), moves};
}

// Drives toward the goal as fast as it can still stop there, at most at `speed`.
Input Autopilot::steer(const Game& game, const Goal& goal, double speed) const {
  const Ball& ball = game.world().ball();
  const dvec2 way(goal.position.x - ball.position.x, goal.position.z - ball.position.z);
  const double distance = glm::length(way);
  if (distance < 0.12) return {};
  const dvec2 direction = way / distance;
  const double wanted = std::min(speed, std::sqrt(2 * 2.0 * distance));
  const double along = glm::dot(dvec2(ball.velocity.x, ball.velocity.z), direction);
  if (along > wanted + 0.35) return {};  // brakes
  const dvec2 push =
      direction * (std::min(wanted + 0.3, game.world().tuning().topSpeed) / game.world().tuning().topSpeed);
  const dvec2 ahead = game.follower().ahead(), right(-ahead.y, ahead.x);
  return Input::of(glm::dot(push, right), glm::dot(push, ahead));
}

Input Autopilot::next(const Game& game) {
  if (game.rules().phase() == Phase::title) {
    *this = {};
    return Input::of(0, 0, 0, 0, kButtonStart);
  }
  if (game.rules().phase() == Phase::finished || game.level().route.empty()) return {};
  const std::size_t points = game.level().route.size();
  const double radius = game.world().tuning().radius;
  const dvec3 foot = game.world().ball().position - dvec3(0, radius, 0);
  Goal to = goal(game, next_);
  if (onLevel(foot, to.position) < kReached && std::abs(foot.y - to.position.y) < 0.3) {
    next_ = (next_ + 1) % points;
    aboard_ = false;
    steps_ = 0;
    to = goal(game, next_);
  }
  // Fell off, or is stuck: back to where the way is on the ground.
  const Goal from = goal(game, (next_ + points - 1) % points);
  if (++steps_ > kPatience ||
      (aboard_ && (to.moves || from.moves) && foot.y < std::min(from.position.y, to.position.y) - 0.3)) {
    do next_ = (next_ + points - 1) % points;
    while (goal(game, next_).moves || goal(game, next_).position.y > 0.05);
    aboard_ = false;
    steps_ = 0;
    to = goal(game, next_);
  }
  const Goal back = goal(game, (next_ + points - 1) % points);
  if (!to.moves && !back.moves) return steer(game, to, kCruise);

  // A platform is boarded and left just after it has come to rest, next to where it stands.
  const dvec3 platform = to.moves ? to.position : back.position;
  stillSteps_ = glm::distance(platform, lastPosition_) < 1e-4 ? stillSteps_ + 1 : 0;
  lastPosition_ = platform;
  const bool near = onLevel(foot, to.position) < kStep && std::abs(foot.y - to.position.y) < kClimb;
  if (near && stillSteps_ > 0 && stillSteps_ < kStepsPerSecond / 2) aboard_ = true;
  return aboard_ ? steer(game, to, kBoarding) : steer(game, back, kBoarding);
}

}  // namespace halfsilver::demo
