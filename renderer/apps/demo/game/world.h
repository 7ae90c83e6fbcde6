#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <vector>

#include "apps/demo/game/triangle_grid.h"

// The ball and what it rolls on. Meters, seconds, y up. A step gives the same result for the same numbers in, always.
namespace halfsilver::demo {

inline constexpr int kSubsteps = 4;  // of a game step
inline constexpr double kSubstepSeconds = 1.0 / 240;

// Distance along the level.
inline double onLevel(const glm::dvec3& a, const glm::dvec3& b) { return std::hypot(a.x - b.x, a.z - b.z); }

struct Ball {
  glm::dvec3 position{0};
  glm::dvec3 velocity{0};
  glm::dvec3 spin{0};  // angular velocity, radians per second
  glm::dquat turn{1, 0, 0, 0};

  bool operator==(const Ball&) const = default;
};

// How the ball feels: 0 to top speed in about a second and a half, to rest in two.
struct BallTuning {
  double radius = 0.4;
  double topSpeed = 6;        // m/s that the player reaches by himself
  double drive = 4.4;         // m/s^2; too little to climb a 10 cm step from rest
  double turnDrive = 7;       // m/s^2 against or across the way that it rolls
  double rolling = 0.25;      // m/s^2, resistance while driven
  double braking = 3;         // m/s^2, while not driven
  double friction = 1.3;      // Coulomb's coefficient
  double wallFriction = 0.3;  // the same of what is steep
  double bounce = 0.25;       // of the speed at which it meets what is steep
  double gravity = 9.81;      // m/s^2
  double maxSpeed = 20;       // m/s, whatever happens; a substep then moves it by a fifth of its radius
};

// Something rigid that moves as it likes: a platform, a gate.
struct MovingBody {
  std::vector<Corners> triangles;  // in its own space
  glm::dmat4 place{1}, before{1};  // at the end and the start of a substep; rigid

  // The velocity of its point that is at `p` at the end of the substep.
  glm::dvec3 velocityAt(const glm::dvec3& p) const;
};

// An upright capsule without mass to speak of: it pushes the ball and is not pushed.
struct Pillar {
  glm::dvec3 foot{0}, before{0};  // at the end and the start of a substep
  double radius = 0.26, height = 1.75;
};

class World {
 public:
  World(TriangleGrid ground, const BallTuning& tuning, const glm::dvec3& start);

  // One substep; `push` is the direction that the player drives in, on the level, at most 1 long. Bodies and pillars
  // are where they are at its end.
  void step(const glm::dvec2& push, const std::vector<MovingBody>& bodies, const std::vector<Pillar>& pillars);

  void put(const glm::dvec3& position);  // at rest
  void returnToSafePlace() { put(safe_); }

  const Ball& ball() const { return ball_; }
  Ball& ball() { return ball_; }
  const TriangleGrid& ground() const { return ground_; }
  const BallTuning& tuning() const { return tuning_; }
  bool touching() const { return grip_ > 0; }         // something that carries it
  std::uint64_t returns() const { return returns_; }  // how often it fell out or was crushed

 private:
  struct Contact {
    glm::dvec3 point{0};
    double distance = 0;
    glm::dvec3 velocity{0};  // of the surface
    bool still = false;      // whether it is part of the ground
  };
  std::optional<Contact> deepest(const std::vector<MovingBody>& bodies, const std::vector<Pillar>& pillars) const;
  void resolve(const Contact& contact);
  void drive(const glm::dvec2& push);

  TriangleGrid ground_;
  BallTuning tuning_;
  Ball ball_;
  glm::dvec3 safe_;
  glm::dvec3 carrier_{0};  // velocity of what carries the ball
  double grip_ = 0;        // of the torque on what carries the ball: how level that is; 0 in the air
  int calmSteps_ = 0;      // in a row on level ground
  std::uint64_t returns_ = 0;
};

}  // namespace halfsilver::demo
