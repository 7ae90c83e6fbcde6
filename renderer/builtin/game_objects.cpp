#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "builtin/game_parts.h"

// What moves by itself or by the player: the ball, gems, platforms, plates, the goal and its gate.
namespace halfsilver::game {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr dvec3 kY(0, 1, 0);

// A convex solid about the origin with flat faces, each given counter-clockwise.
void addFaces(MeshBuilder& build, std::span<const dvec3> corners, std::span<const std::array<int, 3>> faces) {
  for (const std::array<int, 3>& face : faces) {
    std::array<dvec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = corners[static_cast<std::size_t>(face[k])];
    const dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    std::array<std::uint32_t, 3> v{};
    for (std::size_t k = 0; k < 3; ++k) v[k] = build.vertex({p[k], normal, p[1] - p[0], dvec2(p[k].x, -p[k].y)});
    build.triangle(v[0], v[1], v[2]);
  }
}

Mesh gem(int kind, std::uint32_t material) {
  MeshBuilder build;
  build.use(material);
  if (kind == 0) {  // a cut stone: a crown and a pavilion of eight sides
    std::vector<dvec3> corners{dvec3(0, -0.20, 0), dvec3(0, 0.10, 0)};
    std::vector<std::array<int, 3>> faces;
    for (int ring = 0; ring < 2; ++ring)
      for (int i = 0; i < 8; ++i) {
        const double angle = 2 * kPi * (i + 0.5 * ring) / 8, radius = ring == 0 ? 0.19 : 0.11;
        corners.emplace_back(radius * std::sin(angle), ring == 0 ? 0.0 : 0.10, radius * std::cos(angle));
      }
    for (int i = 0; i < 8; ++i) {
      const int a = 2 + i, b = 2 + (i + 1) % 8, c = 10 + i, d = 10 + (i + 1) % 8;
      faces.push_back({0, b, a});
      faces.push_back({a, b, c});
      faces.push_back({b, d, c});
      faces.push_back({1, c, d});
    }
    addFaces(build, corners, faces);
  } else if (kind == 1) {  // an octahedron
    constexpr double kSide = 0.15, kTip = 0.21;
    const std::array<dvec3, 6> corners{dvec3(kSide, 0, 0), dvec3(0, 0, -kSide), dvec3(-kSide, 0, 0),
                                       dvec3(0, 0, kSide), dvec3(0, kTip, 0),   dvec3(0, -kTip, 0)};
    std::vector<std::array<int, 3>> faces;
    for (int i = 0; i < 4; ++i) {
      faces.push_back({i, (i + 1) % 4, 4});
      faces.push_back({(i + 1) % 4, i, 5});
    }
    addFaces(build, corners, faces);
  } else {  // an icosahedron
    const double s = 0.10, l = s * 1.6180339887498949;
    const std::array<dvec3, 12> corners{dvec3(-s, l, 0), dvec3(s, l, 0), dvec3(-s, -l, 0), dvec3(s, -l, 0),
                                        dvec3(0, -s, l), dvec3(0, s, l), dvec3(0, -s, -l), dvec3(0, s, -l),
                                        dvec3(l, 0, -s), dvec3(l, 0, s), dvec3(-l, 0, -s), dvec3(-l, 0, s)};
    constexpr std::array<std::array<int, 3>, 20> faces{{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                                        {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                                        {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                                        {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};
    addFaces(build, corners, faces);
  }
  return build.take();
}

// A platform: its top is at y = 0.
Mesh deck(const Materials& m, double half, double thick) {
  MeshBuilder build;
  build.use(m.deck).box({-half, -thick, -half}, {half, 0, half});
  build.use(m.band);  // a rim around the top's edge
  constexpr double kRim = 0.07;
  for (int side = 0; side < 4; ++side) {
    const double turn = 0.5 * kPi * side;
    MeshBuilder rim;
    rim.use(m.band).box({-half, -thick, half}, {half, 0.004, half + 0.012}, kAllFaces & ~kFaceBack);
    rim.box({-half, 0, half - kRim}, {half, 0.004, half}, kFaceTop);
    build.append(rim.mesh(), {dvec3(0), turn});
  }
  return build.take();
}

// Rests at `from`, eases to `to`, rests there and eases back.
void addShuttle(Model& model, int node, const std::string& name, dvec3 from, dvec3 to, double rest, double travel) {
  Animation animation;
  animation.name = name;
  animation.duration = static_cast<float>(2 * (rest + travel));
  Channel channel;
  channel.node = node;
  channel.property = AnimatedProperty::translation;
  channel.interpolation = Interpolation::cubicSpline;
  const std::array<std::pair<double, dvec3>, 5> keys{
      {{0, from}, {rest, from}, {rest + travel, to}, {2 * rest + travel, to}, {2 * (rest + travel), from}}};
  for (const auto& [time, position] : keys) {
    channel.times.push_back(static_cast<float>(time));
    for (const dvec3& part : {dvec3(0), position, dvec3(0)})  // tangents of 0: it starts and stops smoothly
      for (int axis = 0; axis < 3; ++axis) channel.values.push_back(static_cast<float>(part[axis]));
  }
  animation.channels.push_back(std::move(channel));
  model.rig.animations.push_back(std::move(animation));
}

Mesh disc(std::uint32_t inner, std::uint32_t outer, double radius, double height) {
  MeshBuilder build;
  build.use(outer).lathe(Profile().lines({{0.82 * radius, height}, {0.96 * radius, height}, {radius, 0}}), dvec3(0),
                         40);
  build.use(inner).disc({0, height, 0}, kY, 0.82 * radius, 40);
  return build.take();
}

}  // namespace

void addBall(Model& model, const Materials& m) {
  MeshBuilder build;
  constexpr double kBand = 0.035, kCap = 0.20;  // half angles, of the band and the caps that show how it turns
  const auto part = [&](std::uint32_t material, double from, double to, int rows) {
    build.use(material).lathe(Profile().arc({0, 0}, kBallRadius, from, to, rows), dvec3(0), 64);
  };
  part(m.band, 0.5 * kPi, 0.5 * kPi - kCap, 3);
  part(m.mirror, 0.5 * kPi - kCap, kBand, 14);
  part(m.band, kBand, -kBand, 1);
  part(m.mirror, -kBand, kCap - 0.5 * kPi, 14);
  part(m.band, kCap - 0.5 * kPi, -0.5 * kPi, 3);
  const int node = addNode(model.rig, "ball", -1, {0, kBallRadius, 10.5});
  model.rig.nodes.back().rotation = glm::angleAxis(1.1, glm::normalize(dvec3(0.3, 0.2, 1)));
  attach(model, node, build.mesh());
}

int addPlatforms(Model& model, const Materials& m) {
  const auto platform = [&](int number, dvec3 from, dvec3 to, double half, double thick, double rest, double travel) {
    const std::string name = "platform " + std::to_string(number);
    const int node = addNode(model.rig, name, -1, from);
    attach(model, node, deck(m, half, thick));
    addShuttle(model, node, name, from, to, rest, travel);
    return node;
  };
  platform(1, {5.4, 0.5, 2.72}, {5.4, 0.5, -2.72}, 0.85, 0.14, 2.0, 4.5);
  platform(2, {-5.4, 0.05, 5.08}, {-5.4, 1.0, 5.08}, 0.85, 0.05, 2.5, 3.0);
  return platform(3, {-1.7, 0.05, -5.2}, {1.7, 0.05, -5.2}, 0.85, 0.05, 1.2, 4.0);
}

void addItems(Model& model, const Materials& m, int carpet) {
  constexpr double kFloat = 0.45;
  const std::array<std::pair<dvec3, int>, 12> places{{{{-2.0, 0, 8.2}, -1},
                                                      {{2.0, 0, 8.6}, -1},
                                                      {{-1.05, 0.2, 5.4}, -1},
                                                      {{1.7, 0.36, 4.8}, -1},
                                                      {{5.4, 0.5, 4.5}, -1},
                                                      {{5.4, 0.5, -4.5}, -1},
                                                      {{-5.4, 1.0, 2.4}, -1},
                                                      {{-5.4, 0.5, -2.0}, -1},
                                                      {{0, 0, 0}, carpet},
                                                      {{-2.2, 0, -8.4}, -1},
                                                      {{2.2, 0, -8.4}, -1},
                                                      {{2.5, 0, -2.2}, -1}}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::string name = "item " + std::to_string(i + 1);
    const int node = addNode(model.rig, name, places[i].second, places[i].first + kFloat * kY);
    const int kind = static_cast<int>(i % 3);
    attach(model, node, gem(kind, m.gems[kind]));
    Animation animation;
    animation.name = name;
    animation.duration = 4.5f;
    addRotations(animation, node, 6, [&](double t) { return glm::angleAxis(2 * kPi * t / 4.5, kY); });
    model.rig.animations.push_back(std::move(animation));
  }
}

void addPlates(Model& model, const Materials& m) {
  constexpr std::array<dvec2, kLanterns> places{dvec2(-2.4, -10.2), dvec2(2.5, -3.5), dvec2(-2.5, 3.2),
                                                dvec2(2.4, 10.6)};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const int node = addNode(model.rig, "plate " + std::to_string(i + 1), -1, {places[i].x, 0, places[i].y});
    attach(model, node, disc(m.plate, m.band, 0.42, 0.025));
  }
}

void addGoal(Model& model, const Materials& m) {
  attach(model, addNode(model.rig, "start", -1, {0, 0, 10.5}), disc(m.deck, m.band, 0.7, 0.012));
  constexpr dvec3 kGoal(0, 0, -11.6);
  attach(model, addNode(model.rig, "goal", -1, kGoal), disc(m.goal, m.band, 1.1, 0.02));
  constexpr int kBars = 22;
  constexpr double kRadius = 1.45, kHeight = 1.15;
  MeshBuilder build;
  build.use(m.gate);
  std::vector<dvec3> ring;
  for (int i = 0; i < kBars; ++i) {
    const double angle = 2 * kPi * i / kBars;
    const dvec3 foot(kRadius * std::sin(angle), 0, kRadius * std::cos(angle));
    const std::array<dvec3, 2> bar{foot, foot + kHeight * kY};
    build.tube(bar, 0.025, 6, dvec3(1, 0, 0.2));
    build.lathe(Profile().arc({0, 0}, 0.055, 0.5 * kPi, -0.5 * kPi, 5), foot + (kHeight + 0.05) * kY, 8);
    ring.push_back(foot);
  }
  for (const double y : {0.12, 1.0}) {
    std::vector<dvec3> at = ring;
    for (dvec3& point : at) point += y * kY;
    build.tube(at, 0.028, 6, kY, true);
  }
  attach(model, addNode(model.rig, "gate", -1, kGoal), build.mesh());
}

void addLanterns(Model& model) {
  for (int i = 0; i < kLanterns; ++i) {
    const int node = addNode(model.rig, "lantern " + std::to_string(i + 1), -1,
                             {0, atrium::kLanternFoot - 0.15, atrium::kLanternZ[i]});
    Light light;
    light.type = LightType::point;
    light.color = glm::vec3(1.0f, 0.66f, 0.34f);
    light.intensity = 26.0f;
    light.range = 14.0f;
    model.scene.lights.push_back(light);
    model.rig.lightNodes.push_back(node);
  }
}

void addRoute(Model& model) {
  const auto platform = [&](int number) {
    const std::string name = "platform " + std::to_string(number);
    for (std::size_t i = 0; i < model.rig.nodes.size(); ++i)
      if (model.rig.nodes[i].name == name) return static_cast<int>(i);
    return -1;
  };
  int number = 0;
  const auto point = [&](double x, double y, double z, int parent = -1) {
    addNode(model.rig, "route " + std::to_string(++number), parent, {x, y, z});
  };
  point(2.0, 0, 8.6);
  point(1.7, 0, 8.0);
  point(1.7, 0.36, 4.8);
  point(1.65, 0, 1.95);
  point(0.2, 0, 2.75);
  point(-1.05, 0, 2.6);
  point(-1.05, 0.2, 5.4);
  point(-2.0, 0, 8.2);
  point(2.0, 0, 9.0);
  point(5.2, 0, 9.1);
  point(5.4, 0, 8.5);
  point(5.4, 0.5, 4.5);
  point(0, 0, 0, platform(1));
  point(5.4, 0.5, -4.5);
  point(5.4, 0, -8.4);
  point(5.0, 0, -9.0);
  point(2.2, 0, -8.4);
  point(-2.2, 0, -8.4);
  point(-1.7, 0, -7.0);
  point(0, 0, 0, platform(3));
  point(1.7, 0, -3.5);
  point(2.5, 0, -2.2);
  point(1.7, 0, -3.3);
  point(-2.5, 0, -3.0);
  point(-2.55, 0, 3.2);
  point(-2.55, 0, 5.1);
  point(-3.8, 0, 5.1);
  point(0, 0, 0, platform(2));
  point(-5.4, 1.0, 3.3);
  point(-5.4, 1.0, 2.4);
  point(-5.4, 0.5, -2.0);
  point(-5.4, 0, -5.8);
  point(-5.2, 0, -9.0);
  point(-2.2, 0, -9.2);
  point(0, 0, -11.6);
}

}  // namespace halfsilver::game
