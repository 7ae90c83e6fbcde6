#pragma once

#include <glm/glm.hpp>

#include <halfsilver/scene.h>
#include "apps/demo/game/triangle_grid.h"

// The camera behind the ball. It turns with the player's hand, after a while with the ball's way, and comes closer
// instead of going into a wall.
namespace halfsilver::demo {

// A spring that settles as fast as it can without swinging. Source: Lowe, Game Programming Gems 4, 1.10.
struct Spring {
  glm::dvec3 value{0}, speed{0};
  void follow(const glm::dvec3& goal, double settle, double seconds);
};

class FollowCamera {
 public:
  FollowCamera(const glm::dvec3& ball, double yaw);

  // One step; look is in radians.
  void step(const TriangleGrid& ground, const glm::dvec3& ball, const glm::dvec3& velocity, const glm::dvec2& look);

  double yaw() const { return yaw_; }  // radians, 0 looks along -z, growing to the right
  glm::dvec2 ahead() const;            // on the level (x, z)
  Camera camera() const;
  const glm::dvec3& eye() const { return eye_; }

  static constexpr double kRadius = 0.2;  // of the sphere that stays out of walls

 private:
  double yaw_, pitch_ = 0.27;
  double idleSeconds_ = 0;  // since the player last turned it
  double distance_;
  Spring pivot_;
  glm::dvec3 eye_{0}, target_{0};
};

}  // namespace halfsilver::demo
