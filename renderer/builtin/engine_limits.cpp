#include <cmath>
#include <span>

#include <halfsilver/pose.h>
#include "builtin/failure_stage.h"
#include "builtin/random.h"
#include "builtin/rig_parts.h"

namespace halfsilver {
namespace {

using glm::dvec3;

}  // namespace

// Three soft columns of three joints each, which bow to all sides.
Model makeFigures() {
  constexpr double kHeight = 1.2;
  constexpr int kJoints = 3, kKeys = 12;
  Stage stage;
  stage.floor();
  Model model = stage.finish();
  Animation bow;
  bow.name = "bow";
  bow.duration = 1;
  for (int i = 0; i < 3; ++i) {
    const int root = addNode(model.rig, "figure " + std::to_string(i + 1), -1, {0.9 * (i - 1), 0, -0.2 * i});
    MeshBuilder build;
    build.use(Stage::red + static_cast<std::uint32_t>(i))
        .lathe(Profile().curve(std::initializer_list<glm::dvec2>{
                   {0.02, kHeight}, {0.17, 1.1}, {0.10, 0.9}, {0.18, 0.6}, {0.12, 0.3}, {0.20, 0.02}}),
               dvec3(0), 32);
    Skin skin;
    Chain chain{{}, dvec3(0), kY, 0.15};
    int parent = root;
    for (std::uint32_t joint = 0; joint < kJoints; ++joint) {
      const double at = kHeight / kJoints * joint;
      parent = addNode(model.rig, "joint", parent, joint == 0 ? dvec3(0) : kHeight / kJoints * kY);
      skin.joints.push_back(parent);
      skin.inverseBind.emplace_back(1);
      skin.inverseBind.back()[3] = glm::dvec4(0, -at, 0, 1);
      chain.links.push_back({joint, at});
      const dvec3 axis = glm::normalize(i % 2 ? dvec3(1, 0, 0.5) : dvec3(0.3, 0, 1));
      addRotations(bow, parent, kKeys,
                   [&](double t) { return glm::angleAxis(0.35 * std::sin(2 * kPi * t + joint), axis); });
    }
    Skinned figure;
    figure.add(build.mesh(), chain);
    model.rig.skins.push_back(std::move(skin));
    attach(model, root, figure, static_cast<int>(model.rig.skins.size()) - 1);
  }
  model.rig.animations.push_back(std::move(bow));
  pose(model, std::span<const Playing>());  // at rest
  return model;
}

// A hanging sheet.
Model makeRipples() {
  Stage stage;
  stage.floor();
  stage.ball(Stage::blue, {0.9, 0.3, 0.3}, 0.25);
  stage.build.use(Stage::moving).surface(64, 32, {1, 1}, [](double s, double t) {
    const double x = -1.2 + 1.8 * s, y = 1.2 - 1.15 * t;
    return dvec3(x, y, -0.3 + 0.06 * std::sin(9 * x + 4 * y));
  });
  return stage.finish();
}

void shapeRipples(std::span<Vertex> vertices, int frame) {
  for (Vertex& vertex : vertices) {
    const float phase = 9.0f * vertex.position.x + 4.0f * vertex.position.y;
    vertex.position.z += 0.06f * (std::sin(phase + 0.15f * static_cast<float>(frame)) - std::sin(phase));
  }
}

Model makeCanopy() {
  Stage stage;
  stage.floor();
  Material& leaf = stage.model.scene.materials[Stage::moving];
  leaf.baseColor = glm::vec4(1);
  leaf.baseColorTexture = addTexture(stage.model.scene, leafSprig());
  leaf.alphaMode = AlphaMode::mask;
  stage.build.use(Stage::moving);
  Random random(11);
  for (int i = 0; i < 120; ++i) {
    const double turn = random.between(0, 2 * kPi);
    const double z = random.between(-0.9, 0.5), y = random.between(0.6, 1.3), x = random.between(-1.2, 0.9);
    const dvec3 corner(x, y, z);
    stage.build.rectangle(corner, 0.4 * dvec3(std::cos(turn), 0.2, std::sin(turn)), {0, -0.45, 0.1});
  }
  return stage.finish();
}

// The higher, the farther.
void shapeCanopy(std::span<Vertex> vertices, int frame) {
  for (Vertex& vertex : vertices) {
    const float phase = 3.0f * vertex.position.z;
    vertex.position.x +=
        0.03f * vertex.position.y * (std::sin(phase + 0.2f * static_cast<float>(frame)) - std::sin(phase));
  }
}

// Three tinted panes behind one another, things before, between and behind them.
Model makePanes() {
  Stage stage;
  stage.floor();
  for (int i = 0; i < 3; ++i) {
    Material pane = stage.model.scene.materials[Stage::red + static_cast<std::uint32_t>(i)];
    pane.alphaMode = AlphaMode::blend;
    pane.baseColor.a = 0.3f + 0.1f * static_cast<float>(i);
    stage.build.use(addMaterial(stage.model.scene, pane))
        .rectangle({-1.4 + 0.4 * i, 1.1, -0.6 + 0.4 * i}, {1.9, 0, 0}, {0, -1.05, 0});
  }
  stage.ball(Stage::blue, {-0.5, 0.3, -0.9}, 0.25);
  stage.ball(Stage::green, {0.3, 0.3, -0.1}, 0.15);
  stage.ball(Stage::yellow, {-0.9, 0.2, 0.6}, 0.15);
  return stage.finish();
}

// Four open rooms of different colors; their walls are 2 cm thick and differ from side to side.
Model makeThinWalls() {
  constexpr double kHalf = 0.01;
  Stage stage;
  stage.floor();
  const std::uint32_t colors[] = {Stage::red, Stage::blue, Stage::yellow, Stage::green};
  for (int i = 0; i < 4; ++i) {
    const double left = -1.6 + 0.8 * i, right = left + 0.8;
    stage.build.use(colors[i]).box({left, 0, -1}, {left + kHalf, 0.9, 0.4});
    stage.build.box({right - kHalf, 0, -1}, {right, 0.9, 0.4});
    stage.build.box({left, 0, -1.02}, {right, 0.9, -1});
    stage.ball(colors[(i + 1) % 4], {left + 0.4, 0.25, -0.4}, 0.15);
  }
  return stage.finish();
}

// Seen from its room, whose floor mirrors walls, windows, a table and what is outside.
Model makeOneMesh() {
  Stage stage;
  stage.floor(1.5);
  stage.build.use(Stage::yellow);
  for (const double x : {-1.5, 1.3}) stage.build.box({x, 0, -1.5}, {x + 0.2, 1.6, 1.5});
  stage.build.box({-1.5, 1.6, -1.5}, {1.5, 1.75, 1.5});
  stage.build.use(Stage::red);
  for (int i = 0; i < 3; ++i) stage.build.box({-1.5 + 1.15 * i, 0, -1.5}, {-0.8 + 1.15 * i, 1.6, -1.35});
  stage.build.box({-1.5, 0, -1.5}, {1.5, 0.5, -1.35});
  stage.build.box({-1.5, 1.3, -1.5}, {1.5, 1.6, -1.35});
  stage.build.use(Stage::green).box({-0.5, 0.5, -0.9}, {0.5, 0.55, -0.3});
  for (const double x : {-0.45, 0.4})
    for (const double z : {-0.85, -0.4}) stage.build.box({x, 0, z}, {x + 0.05, 0.5, z + 0.05});
  stage.ball(Stage::blue, {0.1, 0.7, -0.6}, 0.15);
  stage.ball(Stage::red, {-0.6, 0.9, -2.4}, 0.5);
  stage.ball(Stage::blue, {0.7, 0.8, -2.2}, 0.4);
  stage.model.scene.cameras.front() = lookAt("room", {0.2f, 1.1f, 1.4f}, {0, 0.35f, -0.6f}, 60);
  return stage.finish();
}

// A railing of strips 6 mm wide that have no backs, turned to all sides.
Model makeRibbons() {
  Stage stage;
  stage.floor();
  for (Material& material : stage.model.scene.materials) material.doubleSided = false;
  for (int i = 0; i < 60; ++i) {
    const double x = -1.5 + 3.0 * i / 59, turn = 2.4 * i;
    stage.build.use(1 + static_cast<std::uint32_t>(i) % 4)
        .rectangle({x, 1.0, -0.4}, 0.006 * (std::cos(turn) * kX + std::sin(turn) * kZ), -0.95 * kY);
  }
  stage.build.use(Stage::red).rectangle({-1.5, 1.01, -0.4}, 3.0 * kX, -0.006 * kY);
  stage.build.use(Stage::blue).rectangle({-1.5, 0.05, -0.4}, 3.0 * kX, 0.004 * kZ);
  return stage.finish();
}

}  // namespace halfsilver
