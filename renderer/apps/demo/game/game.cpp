#include "apps/demo/game/game.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace halfsilver::demo {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kShrinkSeconds = 0.25;                      // of a collected item
constexpr double kGateSeconds = 1.5, kGateDepth = 1.35;      // in which the gate sinks, and how far
constexpr double kPlateReach = 0.42, kPlatePressed = 0.018;  // meters
constexpr float kGoalGlow = 14, kDusk = 0.04f;

Node& nodeOf(Rig& rig, int node) { return rig.nodes[static_cast<std::size_t>(node)]; }

}  // namespace

Game::Game(Model model)
    : model_(std::move(model)),
      nodes_(model_.rig.nodes),
      lights_(model_.scene.lights),
      materials_(model_.scene.materials),
      sky_(model_.scene.sky),
      level_(model_),
      world_(Level::ground(model_), BallTuning{}, nodeOf(model_.rig, level_.ball).translation),
      camera_(world_.ball().position, 0),
      rules_(level_.items.size()),
      lanterns_(level_.lanternLights.size(), true),
      onPlate_(level_.plates.size(), false) {
  for (const std::vector<Corners>& shape : level_.shapes) bodies_.push_back({shape});
  pillars_.resize(level_.figures.size());
  beginRound();
}

void Game::beginRound() {
  model_.rig.nodes = nodes_;
  const Node& ball = nodeOf(model_.rig, level_.ball);
  world_ = World(world_.ground(), world_.tuning(), ball.translation);
  world_.ball().turn = ball.rotation;
  camera_ = FollowCamera(ball.translation, 0);
  std::fill(onPlate_.begin(), onPlate_.end(), false);
  roundSteps_ = 0;
  placeNodes();
  camera_.step(world_.ground(), world_.ball().position, dvec3(0), dvec2(0));
}

void Game::step(const Input& input) {
  events_.clear();
  const auto pressed = static_cast<std::uint16_t>(input.buttons & ~held_);
  held_ = input.buttons;
  ++steps_;
  ++roundSteps_;
  std::vector<dvec3> items;
  for (const int node : level_.items) items.push_back(positionOf(node));
  const bool wasOpen = rules_.goalOpen();
  if (rules_.step(input, pressed, {world_.ball().position, items, positionOf(level_.goal)}, events_)) beginRound();
  if (rules_.goalOpen() != wasOpen) {
    Material& goal = model_.scene.materials[static_cast<std::size_t>(level_.goalMaterial)];
    const Material& dark = materials_[static_cast<std::size_t>(level_.goalMaterial)];
    goal.emissive = dark.emissive * (rules_.goalOpen() ? kGoalGlow : 1.0f);
    change_.materials = true;
  }
  press(pressed);

  const PoseState before = state_;
  placeNodes();
  const bool playing = rules_.phase() == Phase::playing;
  const dvec2 ahead = camera_.ahead(), right(-ahead.y, ahead.x);
  dvec2 push = (right * static_cast<double>(input.moveX) + ahead * static_cast<double>(input.moveY)) / 127.0;
  if (const double length = glm::length(push); length > 1) push /= length;
  const std::uint64_t returns = world_.returns();
  for (int i = 0; i < kSubsteps; ++i) {
    moveBodies(before, i);
    world_.step(playing ? push : dvec2(0), bodies_, pillars_);
  }
  if (world_.returns() != returns) events_.push_back(Event::returned);
  for (std::size_t i = 0; i < level_.plates.size(); ++i) {
    const bool on = onLevel(world_.ball().position, positionOf(level_.plates[i])) < kPlateReach &&
                    world_.ball().position.y < 2 * world_.tuning().radius;
    if (on && !onPlate_[i]) switchLantern(i);
    onPlate_[i] = on;
  }
  placeNodes();
  constexpr double kToRadians = 3.14159265358979323846 / 18000;
  camera_.step(world_.ground(), world_.ball().position, world_.ball().velocity,
               {input.lookX * kToRadians, input.lookY * kToRadians});
}

void Game::press(std::uint16_t pressed) {
  if (pressed & kButtonReset) {
    world_.returnToSafePlace();
    events_.push_back(Event::returned);
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(lanterns_.size(), 4); ++i)
    if (pressed & (kButtonLantern1 << i)) switchLantern(i);
  if (pressed & kButtonDaylight) switchDaylight();
}

void Game::switchLantern(std::size_t lantern) {
  const bool lit = lanterns_[lantern] = !lanterns_[lantern];
  const auto light = static_cast<std::size_t>(level_.lanternLights[lantern]);
  const auto material = static_cast<std::size_t>(level_.lanternMaterials[lantern]);
  model_.scene.lights[light].intensity = lit ? lights_[light].intensity : 0;
  model_.scene.materials[material].emissive = lit ? materials_[material].emissive : glm::vec3(0);
  change_.lights = change_.materials = true;
  events_.push_back(Event::switchedLantern);
}

void Game::switchDaylight() {
  daylight_ = !daylight_;
  const float share = daylight_ ? 1.0f : kDusk;
  for (std::size_t i = 0; i < lights_.size(); ++i)
    if (lights_[i].type == LightType::directional) model_.scene.lights[i].intensity = share * lights_[i].intensity;
  model_.scene.sky.intensity = share * sky_.intensity;
  change_.lights = change_.sky = true;
  events_.push_back(Event::switchedDaylight);
}

// The nodes as the rules and the ball have them, and the animations at the round's time.
void Game::placeNodes() {
  Rig& rig = model_.rig;
  Node& ball = nodeOf(rig, level_.ball);
  ball.translation = world_.ball().position;
  ball.rotation = world_.ball().turn;
  for (std::size_t i = 0; i < level_.items.size(); ++i) {
    const double since = rules_.sinceCollected(i);
    nodeOf(rig, level_.items[i]).scale = dvec3(since < 0 ? 1 : std::max(0.0, 1 - since / kShrinkSeconds));
  }
  const double sunk = std::clamp(rules_.sinceOpened() / kGateSeconds, 0.0, 1.0);
  nodeOf(rig, level_.gate).translation.y =
      nodes_[static_cast<std::size_t>(level_.gate)].translation.y - kGateDepth * sunk * sunk * (3 - 2 * sunk);
  for (std::size_t i = 0; i < level_.plates.size(); ++i)
    nodeOf(rig, level_.plates[i]).translation.y =
        nodes_[static_cast<std::size_t>(level_.plates[i])].translation.y - (onPlate_[i] ? kPlatePressed : 0);
  state_ = evaluate(rig, playTogether(level_.animations, static_cast<double>(roundSteps_) * kStepSeconds));
}

// Where platforms and figures are in a substep, between the last step and this one.
void Game::moveBodies(const PoseState& before, int substep) {
  const auto between = [&](int node, int part) {
    const auto at = static_cast<std::size_t>(node);
    const double share = static_cast<double>(part) / kSubsteps;
    return glm::mix(before.world[at][3], state_.world[at][3], share);
  };
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    bodies_[i].place = bodies_[i].before = state_.world[static_cast<std::size_t>(level_.platforms[i])];
    bodies_[i].before[3] = between(level_.platforms[i], substep);
    bodies_[i].place[3] = between(level_.platforms[i], substep + 1);
  }
  for (std::size_t i = 0; i < pillars_.size(); ++i) {
    pillars_[i].before = between(level_.figures[i], substep);
    pillars_[i].foot = between(level_.figures[i], substep + 1);
  }
}

SceneChange Game::takeChange() { return std::exchange(change_, {}); }

Hud Game::hud() const {
  Hud hud;
  hud.phase = rules_.phase();
  hud.seconds = rules_.seconds();
  hud.collected = rules_.collected();
  hud.total = rules_.total();
  hud.goalOpen = rules_.goalOpen();
  hud.speed = glm::length(world_.ball().velocity);
  hud.lanterns = lanterns_;
  hud.daylight = daylight_;
  switch (hud.phase) {
    case Phase::title:
      hud.message = "Collect all " + std::to_string(hud.total) + " stones, then roll to the goal";
      break;
    case Phase::playing:
      if (hud.goalOpen) hud.message = "The gate is open";
      break;
    case Phase::finished:
      hud.message = "Round finished";
      break;
  }
  return hud;
}

}  // namespace halfsilver::demo
