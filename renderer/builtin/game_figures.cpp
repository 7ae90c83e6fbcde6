#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "builtin/game_parts.h"

// Three smooth figures, each one skinned mesh over fourteen joints: one walks around the knot, one waves at the start,
// one dances beside the goal. They stand on y = 0 and face +z at rest, arms hanging.
namespace halfsilver::game {
namespace {

using glm::dquat;
using glm::dvec2;
using glm::dvec3;

enum Joint : std::uint32_t {
  kHips,
  kSpine,
  kChest,
  kHead,
  kArmLeft,
  kForearmLeft,
  kArmRight,
  kForearmRight,
  kThighLeft,
  kShinLeft,
  kFootLeft,
  kThighRight,
  kShinRight,
  kFootRight,
  kJoints
};

constexpr double kHipHeight = 0.93, kKneeHeight = 0.50, kAnkleHeight = 0.08;
constexpr double kUpperArm = 0.30;

struct JointPlace {
  const char* name;
  int parent;  // a Joint, -1: the figure
  dvec3 at;    // in the figure's space
};

dvec3 armDirection(double side) { return glm::normalize(dvec3(0.16 * side, -1, 0)); }
dvec3 shoulder(double side) { return {0.205 * side, 1.40, 0}; }

std::array<JointPlace, kJoints> jointPlaces() {
  const dvec3 elbowLeft = shoulder(1) + kUpperArm * armDirection(1);
  const dvec3 elbowRight = shoulder(-1) + kUpperArm * armDirection(-1);
  return {{{"hips", -1, {0, 0.98, 0}},
           {"spine", kHips, {0, 1.10, 0}},
           {"chest", kSpine, {0, 1.26, 0}},
           {"head", kChest, {0, 1.53, 0}},
           {"left arm", kChest, shoulder(1)},
           {"left forearm", kArmLeft, elbowLeft},
           {"right arm", kChest, shoulder(-1)},
           {"right forearm", kArmRight, elbowRight},
           {"left thigh", kHips, {0.10, kHipHeight, 0}},
           {"left shin", kThighLeft, {0.10, kKneeHeight, 0}},
           {"left foot", kShinLeft, {0.10, kAnkleHeight, 0}},
           {"right thigh", kHips, {-0.10, kHipHeight, 0}},
           {"right shin", kThighRight, {-0.10, kKneeHeight, 0}},
           {"right foot", kShinRight, {-0.10, kAnkleHeight, 0}}}};
}

// A smooth solid of revolution through (radius, position along the axis), from its far end down; then scaled.
Mesh limb(std::uint32_t material, std::span<const dvec2> outline, dvec3 base, dvec3 axis, dvec3 scale = dvec3(1)) {
  constexpr int kSides = 14, kBetween = 3;
  std::vector<dvec2> smooth;
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
    const dvec2 before = outline[i == 0 ? 0 : i - 1], from = outline[i], to = outline[i + 1],
                after = outline[std::min(i + 2, outline.size() - 1)];
    for (int k = 0; k < kBetween; ++k) {  // Catmull-Rom
      const double t = static_cast<double>(k) / kBetween;
      const dvec2 p = from + 0.5 * t *
                                 ((to - before) + t * ((2.0 * before - 5.0 * from + 4.0 * to - after) +
                                                       t * (3.0 * (from - to) + after - before)));
      smooth.emplace_back(std::max(p.x, 0.0), p.y);
    }
  }
  smooth.push_back(outline.back());
  MeshBuilder build;
  build.use(material).lathe(Profile().curve(smooth), dvec3(0), kSides, axis);
  Mesh mesh = build.take();
  for (Vertex& vertex : mesh.vertices) {
    vertex.position = glm::vec3(base + scale * dvec3(vertex.position));
    vertex.normal = glm::vec3(glm::normalize(dvec3(vertex.normal) / scale));
    vertex.tangent = glm::vec4(glm::vec3(glm::normalize(scale * dvec3(glm::vec3(vertex.tangent)))), 1.0f);
  }
  return mesh;
}

Skinned body(const Materials& m, std::uint32_t skin) {
  Skinned figure;
  const Chain trunk{{{kHips, 0}, {kSpine, 1.08}, {kChest, 1.24}, {kHead, 1.53}}, dvec3(0), kY, 0.07};
  const std::vector<dvec2> torso{{0, 1.51},     {0.09, 1.495}, {0.168, 1.43}, {0.186, 1.34}, {0.168, 1.22},
                                 {0.138, 1.09}, {0.150, 0.98}, {0.158, 0.91}, {0.11, 0.845}, {0, 0.82}};
  figure.add(limb(skin, torso, dvec3(0), kY, {1.08, 1, 0.66}), trunk);
  const std::vector<dvec2> head{{0, 1.80},     {0.055, 1.785}, {0.092, 1.73}, {0.100, 1.68},
                                {0.088, 1.61}, {0.055, 1.56},  {0.045, 1.52}, {0.05, 1.47}};
  figure.add(limb(skin, head, dvec3(0), kY), {{{kChest, 0}, {kHead, 1.53}}, dvec3(0), kY, 0.04});
  const std::vector<dvec2> visor{{0, 0.108}, {0.03, 0.106}, {0.052, 0.094}, {0.062, 0.07}};
  figure.add(limb(m.visor, visor, {0, 1.685, 0}, kZ, {1.15, 0.62, 1}), {{{kHead, 0}}, dvec3(0), kY, 1});
  for (const double side : {1.0, -1.0}) {
    const bool left = side > 0;
    const dvec3 down = armDirection(side);
    const std::vector<dvec2> arm{{0, 0.06},      {0.045, 0.045}, {0.060, 0},     {0.052, -0.15}, {0.041, -0.30},
                                 {0.043, -0.38}, {0.030, -0.55}, {0.040, -0.61}, {0.030, -0.67}, {0, -0.69}};
    figure.add(limb(skin, arm, shoulder(side), -down),
               {{{kChest, 0}, {left ? kArmLeft : kArmRight, -0.01}, {left ? kForearmLeft : kForearmRight, kUpperArm}},
                shoulder(side),
                down,
                0.06});
    const dvec3 hip(0.10 * side, kHipHeight, 0);
    const std::vector<dvec2> leg{{0, 0.06},      {0.07, 0.04},   {0.092, -0.03}, {0.084, -0.20}, {0.060, -0.40},
                                 {0.062, -0.50}, {0.056, -0.60}, {0.036, -0.80}, {0.032, -0.87}, {0, -0.89}};
    figure.add(limb(skin, leg, hip, kY), {{{kHips, 0},
                                           {left ? kThighLeft : kThighRight, 0.02},
                                           {left ? kShinLeft : kShinRight, kHipHeight - kKneeHeight},
                                           {left ? kFootLeft : kFootRight, kHipHeight - kAnkleHeight}},
                                          hip,
                                          -kY,
                                          0.06});
    const std::vector<dvec2> foot{{0, 0.17}, {0.035, 0.16}, {0.048, 0.10}, {0.046, 0}, {0.036, -0.06}, {0, -0.075}};
    figure.add(limb(skin, foot, {0.10 * side, 0.046, 0}, kZ, {1, 0.95, 1}),
               {{{left ? kFootLeft : kFootRight, 0}}, dvec3(0), kY, 1});
  }
  return figure;
}

struct Figure {
  int node;                         // of the whole
  std::array<int, kJoints> joints;  // nodes
};

Figure addFigure(Model& model, const Materials& m, int number, dvec3 at, double turn) {
  Rig& rig = model.rig;
  const std::string name = "figure " + std::to_string(number);
  Figure figure{addNode(rig, name, -1, at), {}};
  rig.nodes.back().rotation = glm::angleAxis(turn, kY);
  const std::array<JointPlace, kJoints> places = jointPlaces();
  Skin skin;
  for (std::size_t j = 0; j < kJoints; ++j) {
    const int parent = places[j].parent;
    const auto above = static_cast<std::size_t>(std::max(parent, 0));
    figure.joints[j] = addNode(rig, name + " " + places[j].name, parent < 0 ? figure.node : figure.joints[above],
                               parent < 0 ? places[j].at : places[j].at - places[above].at);
    skin.joints.push_back(figure.joints[j]);
    glm::dmat4 inverse(1);
    inverse[3] = glm::dvec4(-places[j].at, 1);
    skin.inverseBind.push_back(inverse);
  }
  rig.skins.push_back(std::move(skin));
  attach(model, figure.node, body(m, m.figures[number - 1]), static_cast<int>(rig.skins.size()) - 1);
  return figure;
}

dquat about(dvec3 axis, double angle) { return glm::angleAxis(angle, axis); }

// An animation of a figure's joints; `cycles` of its phase, 2 pi each, make a loop.
class Moves {
 public:
  Moves(const Figure& figure, const char* name, double seconds, double cycles, int keys)
      : figure_(&figure), radiansPerSecond_(2 * kPi * cycles / seconds), keys_(keys) {
    animation_.name = name;
    animation_.duration = static_cast<float>(seconds);
  }

  double phase(double seconds) const { return radiansPerSecond_ * seconds; }
  // By the phase.
  void turn(Joint joint, const std::function<dquat(double)>& at) {
    addRotations(animation_, figure_->joints[joint], keys_, [&](double t) { return at(phase(t)); });
  }
  void shift(Joint joint, const std::function<dvec3(double)>& at) {
    addTranslations(animation_, figure_->joints[joint], keys_, [&](double t) { return at(phase(t)); });
  }
  // The figure as a whole, by the time in seconds.
  void lead(const std::function<dvec3(double)>& place, const std::function<dquat(double)>& heading) {
    addTranslations(animation_, figure_->node, keys_, place);
    addRotations(animation_, figure_->node, keys_, heading);
  }
  void addTo(Model& model) && { model.rig.animations.push_back(std::move(animation_)); }

 private:
  const Figure* figure_;
  double radiansPerSecond_;
  int keys_;
  Animation animation_;
};

// Walks around the middle of the hall.
void addWalk(Model& model, const Figure& figure) {
  constexpr double kRadius = 1.78, kStride = 1.2;  // meters, seconds of two steps
  constexpr int kStrides = 8;
  Moves walk(figure, "figure 1 walks", kStrides * kStride, kStrides, kStrides * 12);
  const auto around = [](double t) { return 2 * kPi * t / (kStrides * kStride); };
  walk.lead([&](double t) { return dvec3(kRadius * std::sin(around(t)), 0, kRadius * std::cos(around(t))); },
            [&](double t) { return about(kY, around(t) + 0.5 * kPi); });
  walk.shift(kHips, [](double p) { return dvec3(0.02 * std::sin(p), 0.955 + 0.018 * std::cos(2 * p), 0); });
  walk.turn(kHips, [](double p) { return about(kY, 0.10 * std::sin(p)); });
  walk.turn(kChest, [](double p) { return about(kY, -0.22 * std::sin(p)) * about(kX, 0.05); });
  walk.turn(kHead, [](double p) { return about(kY, 0.14 * std::sin(p)); });
  for (const double side : {1.0, -1.0}) {
    const bool left = side > 0;
    // The leg is in front at sin = 1 and swings forward, its knee bent, while the cosine is positive.
    walk.turn(left ? kThighLeft : kThighRight,
              [side](double p) { return about(kX, -0.44 * side * std::sin(p) - 0.10); });
    walk.turn(left ? kShinLeft : kShinRight,
              [side](double p) { return about(kX, 0.16 + 0.85 * std::max(0.0, side * std::cos(p))); });
    walk.turn(left ? kFootLeft : kFootRight, [side](double p) {
      return about(kX, -0.06 + 0.25 * side * std::sin(p + 0.6) * (side * std::cos(p) > 0 ? 1.0 : 0.6));
    });
    walk.turn(left ? kArmLeft : kArmRight, [side](double p) { return about(kX, 0.50 * side * std::sin(p)); });
    walk.turn(left ? kForearmLeft : kForearmRight,
              [side](double p) { return about(kX, -0.40 + 0.25 * side * std::sin(p)); });
  }
  std::move(walk).addTo(model);
}

void addWave(Model& model, const Figure& figure) {
  Moves wave(figure, "figure 2 waves", 3.2, 1, 48);
  wave.turn(kArmRight, [](double p) { return about(kZ, -2.30 + 0.08 * std::sin(4 * p)); });
  wave.turn(kForearmRight, [](double p) { return about(kZ, -0.35 + 0.50 * std::sin(4 * p)); });
  wave.turn(kArmLeft, [](double p) { return about(kX, 0.10 * std::sin(p)) * about(kZ, 0.12); });
  wave.turn(kForearmLeft, [](double p) { return about(kX, -0.35 - 0.10 * std::sin(p)); });
  wave.turn(kSpine, [](double p) { return about(kZ, 0.05 * std::sin(p)); });
  wave.turn(kChest, [](double p) { return about(kY, 0.10 * std::sin(p)); });
  wave.turn(kHead, [](double p) { return about(kZ, 0.12 * std::sin(2 * p)) * about(kX, 0.05 * std::cos(p)); });
  std::move(wave).addTo(model);
}

void addDance(Model& model, const Figure& figure) {
  Moves dance(figure, "figure 3 dances", 4, 2, 64);
  const auto bend = [](double p) { return 0.30 + 0.22 * std::cos(2 * p); };
  // The hips sink as far as the bent knees ask for, so that the feet stay on the floor.
  dance.shift(kHips, [&bend](double p) {
    const double legs = kHipHeight - kAnkleHeight;
    return dvec3(0.05 * std::sin(p), 0.98 - legs * (1 - std::cos(bend(p))), 0);
  });
  dance.turn(kHips, [](double p) { return about(kZ, 0.10 * std::sin(p)); });
  dance.turn(kSpine, [](double p) { return about(kZ, -0.12 * std::sin(p)) * about(kY, 0.20 * std::sin(p)); });
  dance.turn(kChest, [](double p) { return about(kY, 0.25 * std::sin(p)); });
  dance.turn(kHead, [](double p) { return about(kZ, -0.15 * std::sin(p)); });
  for (const double side : {1.0, -1.0}) {
    const bool left = side > 0;
    dance.turn(left ? kThighLeft : kThighRight,
               [&bend](double p) { return about(kZ, -0.10 * std::sin(p)) * about(kX, -bend(p)); });
    dance.turn(left ? kShinLeft : kShinRight, [&bend](double p) { return about(kX, 2 * bend(p)); });
    dance.turn(left ? kFootLeft : kFootRight, [&bend](double p) { return about(kX, -bend(p)); });
    dance.turn(left ? kArmLeft : kArmRight,
               [side](double p) { return about(kZ, side * (1.55 + 0.55 * std::sin(p + (side > 0 ? 0 : kPi)))); });
    dance.turn(left ? kForearmLeft : kForearmRight,
               [side](double p) { return about(kZ, side * (0.75 + 0.45 * std::cos(p + (side > 0 ? 0 : kPi)))); });
  }
  std::move(dance).addTo(model);
}

}  // namespace

void addFigures(Model& model, const Materials& m) {
  addWalk(model, addFigure(model, m, 1, {0, 0, 1.78}, 0.5 * kPi));
  addWave(model, addFigure(model, m, 2, {-2.6, 0, 7.5}, 0.75));
  addDance(model, addFigure(model, m, 3, {2.15, 0, -11.4}, -0.4));
}

}  // namespace halfsilver::game
