#include "apps/demo/game/world.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace halfsilver::demo {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr dvec3 kUp(0, 1, 0);
constexpr double kLevel = 0.9;     // y of a normal on which the ball may come to rest
constexpr double kCarrying = 0.6;  // y of a normal that carries it
constexpr double kFallen = -3;     // y below which it is lost
constexpr double kInertia = 0.4;   // of a solid sphere, times mass and radius squared
constexpr int kMaxContacts = 6;    // resolved per substep

// Made shorter by at most `amount`.
dvec3 shortened(const dvec3& v, double amount) {
  const double length = glm::length(v);
  return length <= amount ? dvec3(0) : v * (1 - amount / length);
}

}  // namespace

dvec3 MovingBody::velocityAt(const dvec3& p) const {
  const dvec3 local = glm::transpose(glm::dmat3(place)) * (p - dvec3(place[3]));
  return (p - dvec3(before * glm::dvec4(local, 1))) / kSubstepSeconds;
}

World::World(TriangleGrid ground, const BallTuning& tuning, const dvec3& start)
    : ground_(std::move(ground)), tuning_(tuning), safe_(start) {
  ball_.position = start;
}

void World::put(const dvec3& position) {
  ball_.position = position;
  ball_.velocity = ball_.spin = carrier_ = dvec3(0);
  grip_ = 0;
  calmSteps_ = 0;
}

std::optional<World::Contact> World::deepest(const std::vector<MovingBody>& bodies,
                                             const std::vector<Pillar>& pillars) const {
  constexpr double kSlop = 1e-9;
  std::optional<Contact> found;
  const auto reach = [&] { return found ? found->distance : tuning_.radius - kSlop; };
  if (const auto touch = ground_.nearest(ball_.position, reach()))
    found = {touch->point, touch->distance, dvec3(0), true};
  for (const MovingBody& body : bodies) {
    const glm::dmat3 turn(body.place);
    const dvec3 local = glm::transpose(turn) * (ball_.position - dvec3(body.place[3]));
    if (const auto touch = nearestTouch(body.triangles, local, reach())) {
      const dvec3 point = turn * touch->point + dvec3(body.place[3]);
      found = {point, touch->distance, body.velocityAt(point), false};
    }
  }
  for (const Pillar& pillar : pillars) {
    const dvec3 axis =
        pillar.foot + kUp * std::clamp(ball_.position.y - pillar.foot.y, pillar.radius, pillar.height - pillar.radius);
    const dvec3 away = ball_.position - axis;
    const double distance = glm::length(away);
    if (!(distance > 0) || distance - pillar.radius >= reach()) continue;
    found = {axis + away * (pillar.radius / distance), std::max(distance - pillar.radius, 0.0),
             (pillar.foot - pillar.before) / kSubstepSeconds, false};
  }
  return found;
}

void World::resolve(const Contact& contact) {
  if (!(contact.distance > 0)) return;  // the center is on the surface: there is no way out to choose
  const dvec3 normal = (ball_.position - contact.point) / contact.distance;
  ball_.position = contact.point + normal * tuning_.radius;
  const dvec3 relative = ball_.velocity - contact.velocity;
  const double into = -glm::dot(relative, normal);
  if (normal.y > kCarrying) {
    grip_ = std::max(grip_, normal.y);
    carrier_ = contact.velocity;
  }
  if (contact.still && normal.y > kLevel) ++calmSteps_;
  if (into <= 0) return;
  // Impulses per mass. Walls give a little of the speed back, floors only of a fall.
  const double bounce = into > (normal.y > kCarrying ? 2.0 : 0.5) ? tuning_.bounce : 0.0;
  const double push = into * (1 + bounce);
  ball_.velocity += push * normal;
  const dvec3 arm = -tuning_.radius * normal;
  const dvec3 surface = ball_.velocity + glm::cross(ball_.spin, arm) - contact.velocity;
  const dvec3 slip = surface - normal * glm::dot(surface, normal);
  const double speed = glm::length(slip);
  if (!(speed > 0)) return;
  const double grip =
      std::min(speed / (1 + 1 / kInertia), (normal.y > kCarrying ? tuning_.friction : tuning_.wallFriction) * push);
  const dvec3 impulse = slip * (-grip / speed);
  ball_.velocity += impulse;
  ball_.spin += glm::cross(arm, impulse) / (kInertia * tuning_.radius * tuning_.radius);
}

// The player's torque: it becomes speed through friction, so that it does nothing in the air.
void World::drive(const dvec2& push) {
  if (grip_ <= 0) return;
  const double length = std::min(glm::length(push), 1.0);
  const dvec2 rolling(ball_.velocity.x - carrier_.x, ball_.velocity.z - carrier_.z);
  const double toSpin = (1 + kInertia) / kInertia / tuning_.radius * grip_ * kSubstepSeconds;
  if (length > 0) {
    const dvec2 way = push / glm::length(push);
    const double along = glm::dot(rolling, way);
    // What it has beside the wanted direction goes first, then the speed grows up to the top.
    const dvec2 beside = rolling - way * along;
    const double left = std::clamp((tuning_.topSpeed * length - along) / 0.5, 0.0, 1.0);
    dvec2 force = way * length * left * (along < -0.3 ? tuning_.turnDrive : tuning_.drive);
    if (const double drift = glm::length(beside); drift > 0)
      force -= beside * (tuning_.turnDrive * length * std::min(1.0, drift / 0.5) / drift);
    ball_.spin += toSpin * glm::cross(kUp, dvec3(force.x, 0, force.y));
  }
  // Resistance slows rolling and speed alike, so that it never makes the ball slip.
  const double loss = (length > 0 ? tuning_.rolling : tuning_.braking) * kSubstepSeconds;
  const dvec3 level(rolling.x, 0, rolling.y);
  ball_.velocity += shortened(level, loss) - level;
  ball_.spin = shortened(ball_.spin, loss / tuning_.radius);
}

void World::step(const dvec2& push, const std::vector<MovingBody>& bodies, const std::vector<Pillar>& pillars) {
  drive(push);
  ball_.velocity.y -= tuning_.gravity * kSubstepSeconds;
  if (const double speed = glm::length(ball_.velocity); speed > tuning_.maxSpeed)
    ball_.velocity *= tuning_.maxSpeed / speed;
  ball_.position += ball_.velocity * kSubstepSeconds;
  grip_ = 0;
  const int calm = calmSteps_;
  std::optional<Contact> contact;
  double depth = 0;
  for (int i = 0; i < kMaxContacts && (contact = deepest(bodies, pillars)); ++i) {
    depth = tuning_.radius - contact->distance;
    resolve(*contact);
  }
  if (grip_ <= 0) carrier_ = dvec3(0);
  const bool crushed = contact && depth > 0.5 * tuning_.radius;
  if (const double rate = glm::length(ball_.spin); rate > 0)
    ball_.turn = glm::normalize(glm::angleAxis(rate * kSubstepSeconds, ball_.spin / rate) * ball_.turn);
  if (calmSteps_ == calm) calmSteps_ = 0;
  if (calmSteps_ >= 60) {
    safe_ = ball_.position;
    calmSteps_ = 0;
  }
  if (crushed || ball_.position.y < kFallen) {
    ++returns_;
    returnToSafePlace();
  }
}

}  // namespace halfsilver::demo
