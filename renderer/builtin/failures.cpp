#include <array>
#include <cmath>
#include <utility>

#include <halfsilver/builtin.h>
#include "builtin/failure_stage.h"
#include "builtin/random.h"

namespace halfsilver {
namespace {

using glm::dvec3;

void threeBalls(Stage& stage) {
  stage.ball(Stage::red, {-0.8, 0.35, 0}, 0.3);
  stage.ball(Stage::green, {0, 0.35, -0.4}, 0.3);
  stage.ball(Stage::blue, {0.8, 0.35, 0}, 0.3);
}

// In each voxel of a wall, two small horizontal triangles win the vote for the axis, two to one: the wall is lost.
Model outvoted() {
  Stage stage;
  stage.floor();
  stage.build.use(Stage::red).rectangle({-1.5, 1.0, -0.5}, {3, 0, 0}, {0, -1, 0});
  stage.build.use(Stage::yellow);
  for (int i = 0; i < 48; ++i)
    for (int j = 0; j < 16; ++j)
      for (int k = 0; k < 2; ++k) {
        const dvec3 at(-1.5 + i / 16.0 + 0.02, 0.02 + j / 16.0 + 0.01 * k, -0.49);
        stage.triangle(at, at + dvec3(0.01, 0, 0), at + dvec3(0, 0, 0.01));
      }
  return stage.finish();
}

Model mixedNormals() {
  Stage stage;
  stage.floor();
  Random random(7);
  for (int i = 0; i < 600; ++i) {
    const auto point = [&](double size) {
      const double z = random.between(-size, size), y = random.between(-size, size), x = random.between(-size, size);
      return dvec3(x, y, z);
    };
    stage.build.use(1 + static_cast<std::uint32_t>(i) % 4);
    const dvec3 at = dvec3(0, 0.65, 0) + point(0.5);
    const dvec3 c = at + point(0.1), b = at + point(0.1), a = at + point(0.1);
    stage.triangle(a, b, c);
  }
  return stage.finish();
}

// Rods that point at the camera's mirror image, and hanging wires.
Model rods() {
  Stage stage;
  stage.floor();
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 4; ++j) {
      const dvec3 start(-0.8 + 0.2 * i, 0.2 + 0.2 * j, 0.4);
      const dvec3 towards = glm::normalize(dvec3(0.3, -1.5, 3.4) - start);
      const dvec3 points[] = {start, start - 1.2 * towards};
      stage.build.use(1 + static_cast<std::uint32_t>(i + j) % 4).tube(points, 0.003, 6, {1, 0, 0});
    }
  for (int i = 0; i < 40; ++i) {
    const double x = -1.5 + 3.0 * i / 39;
    const dvec3 points[] = {{x, 0.02, -1}, {x, 1.2, -1}};
    stage.build.use(Stage::blue).tube(points, 0.0015, 4, {1, 0, 0});
  }
  return stage.finish();
}

// Front and back of a board 8 mm thick, of different colors, at 30 degrees.
Model sheets() {
  Stage stage;
  stage.floor();
  const dvec3 right(1, 0, 0), down(0, -0.5, 0.866), normal = glm::cross(down, right);
  for (int i = 0; i < 3; ++i) {
    const dvec3 corner(-1.4 + i, 0.9, -0.4);
    stage.build.use(Stage::red).rectangle(corner, 0.8 * right, 0.8 * down);
    stage.build.use(Stage::blue).rectangle(corner + 0.008 * normal, 0.8 * right, 0.8 * down);
  }
  return stage.finish();
}

// One-sided: a box without a lid, half a ball, and a ball whose triangles do not meet.
Model openSurfaces() {
  Stage stage;
  stage.floor();
  for (Material& material : stage.model.scene.materials) material.doubleSided = false;
  stage.build.use(Stage::red).box({-1.3, 0.1, -0.4}, {-0.6, 0.8, 0.3}, kAllFaces & ~(kFaceTop | kFaceBack));
  stage.build.use(Stage::green).lathe(Profile().arc({0, 0}, 0.4, 0, -0.5 * kPi, 16), {0, 0.6, 0}, 32);
  MeshBuilder closed;
  closed.lathe(Profile().arc({0, 0}, 0.4, 0.5 * kPi, -0.5 * kPi, 12), {1, 0.55, 0}, 24);
  stage.build.use(Stage::blue);
  for (const Triangle& triangle : closed.mesh().triangles) {
    const auto corner = [&](std::size_t i) { return dvec3(closed.mesh().vertices[triangle.vertices[i]].position); };
    const dvec3 middle = (corner(0) + corner(1) + corner(2)) / 3.0;
    stage.triangle(glm::mix(corner(0), middle, 0.1), glm::mix(corner(1), middle, 0.1),
                   glm::mix(corner(2), middle, 0.1));
  }
  return stage.finish();
}

Model coplanar() {
  Stage stage;
  stage.floor();
  stage.build.use(Stage::red).rectangle({-1, 1, -0.5}, {1.2, 0, 0}, {0, -0.8, 0});
  stage.build.use(Stage::blue).rectangle({-0.4, 0.8, -0.5}, {1.2, 0, 0}, {0, -0.8, 0});
  stage.build.use(Stage::yellow).box({-0.3, 0, -0.2}, {0.3, 0.3, 0.3});  // stands in the floor's plane
  return stage.finish();
}

Model smallTriangles() {
  Stage stage;
  stage.floor();
  stage.ball(Stage::red, {-0.5, 0.3, 0}, 0.2, 128);
  stage.ball(Stage::green, {0.2, 0.2, 0.2}, 0.1, 128);
  stage.ball(Stage::blue, {0.6, 0.15, 0.4}, 0.05, 128);
  return stage.finish();
}

Model hugeAndTiny() {
  Stage stage;
  stage.floor(1000);
  stage.build.use(Stage::yellow).rectangle({-1000, 600, -900}, {2000, 0, 0}, {0, -600, 0});
  threeBalls(stage);
  return stage.finish();
}

Model grazing() {
  Stage stage;
  stage.floor();
  threeBalls(stage);
  stage.model.scene.cameras.front() = lookAt("grazing", {0.3f, 0.03f, 1.9f}, {0, 0.02f, 0}, 45);
  return stage.finish();
}

Model facingMirrors() {
  Stage stage;
  stage.floor();
  stage.build.use(stage.mirror).rectangle({-1.5, 1.2, -1}, {3, 0, 0}, {0, -1.2, 0});
  stage.build.rectangle({1.5, 1.2, 1}, {-3, 0, 0}, {0, -1.2, 0});
  threeBalls(stage);
  stage.model.scene.cameras.front() = lookAt("between", {1.4f, 0.9f, 0.85f}, {-0.3f, 0.4f, -0.9f}, 60);
  return stage.finish();
}

Model leaves() {
  Stage stage;
  stage.floor();
  Material leaf = dielectric("leaf", glm::vec3(1), 0.8f);
  leaf.baseColorTexture = addTexture(stage.model.scene, leafSprig());
  leaf.alphaMode = AlphaMode::mask;
  leaf.doubleSided = true;
  stage.build.use(addMaterial(stage.model.scene, leaf));
  Random random(3);
  for (int i = 0; i < 60; ++i) {
    const double turn = random.between(0, 2 * kPi);
    const double z = random.between(-0.9, 0.6), y = random.between(0.5, 1.2), x = random.between(-1.2, 0.9);
    const dvec3 corner(x, y, z);
    const dvec3 right = 0.4 * dvec3(std::cos(turn), 0.2, std::sin(turn));
    const std::uint32_t first = stage.build.vertex({corner, {0, 0, 1}, right, {0, 0}});
    stage.build.vertex({corner + dvec3(0, -0.5, 0), {0, 0, 1}, right, {0, 1}});
    stage.build.vertex({corner + right + dvec3(0, -0.5, 0), {0, 0, 1}, right, {1, 1}});
    stage.build.vertex({corner + right, {0, 0, 1}, right, {1, 0}});
    stage.build.triangle(first, first + 1, first + 2);
    stage.build.triangle(first, first + 2, first + 3);
  }
  return stage.finish();
}

// The three balls, so far out that floats are 2 mm apart.
Model farAway() {
  Stage stage;
  stage.floor();
  threeBalls(stage);
  Model model = stage.finish();
  const glm::vec3 shift(20000, 3000, -16000);
  for (Vertex& vertex : model.scene.vertices) vertex.position += shift;
  model.scene.cameras.front().eye += shift;
  model.scene.cameras.front().target += shift;
  return model;
}

Model millimetres() {
  Stage stage;
  stage.floor();
  threeBalls(stage);
  Model model = stage.finish();
  for (Vertex& vertex : model.scene.vertices) vertex.position *= 1000.0f;
  model.scene.cameras.front().eye *= 1000.0f;
  model.scene.cameras.front().target *= 1000.0f;
  return model;
}

Model crossing() {
  Stage stage;
  stage.floor();
  stage.build.use(Stage::blue).rectangle({-1, 1, -0.8}, {2, 0, 0}, {0, -1, 0});
  stage.build.use(Stage::moving).box({-0.3, 0.2, -0.3}, {0.3, 0.5, 0.3});
  return stage.finish();
}

// A ball that unfolds: the previous frame cannot know how many fragments will come.
Model growing() {
  Stage stage;
  stage.floor();
  stage.ball(Stage::moving, {0, 0.6, 0}, 0.005, 48);
  return stage.finish();
}

constexpr SlowMove kSideways{{0.002f, 0, 0}, {}, 1};

constexpr std::array<FailureScene, 22> kFailures{{
    {"outvoted", "a large triangle outvoted by two small ones in each voxel", outvoted, kSideways},
    {"mixed-normals", "triangles of all directions in one voxel", mixedNormals, kSideways},
    {"rods", "thin rods seen end-on, thin wires", rods, kSideways},
    {"sheets", "two sheets inside one voxel", sheets, kSideways},
    {"open", "surfaces that are open, one-sided or not watertight", openSurfaces, kSideways},
    {"coplanar", "surfaces that overlap in one plane", coplanar, kSideways},
    {"small-triangles", "triangles smaller than a texel", smallTriangles, kSideways},
    {"huge-and-tiny", "tiny things on a floor of two kilometers", hugeAndTiny, kSideways},
    {"grazing", "a mirror seen at a grazing angle", grazing, kSideways},
    {"facing-mirrors", "two mirrors that face each other", facingMirrors, kSideways, 5},
    {"leaves", "alpha-masked leaves", leaves, kSideways},
    {"far-away", "a scene 25 km from the origin", farAway, {{0.0625f, 0, 0}, {}, 1}},
    {"millimetres", "a scene in millimeters", millimetres, {{2, 0, 0}, {}, 1}},
    {"crossing", "an object that crosses a voxel border slowly", crossing, {{}, {0, 0, 0.008f}, 1}},
    {"growing", "more fragments at once than the pool was made for", growing, {{}, {}, 4}},
    {"figures", "skinned figures in motion", makeFigures, {.seconds = 1.0 / 24}},
    {"ripples", "vertices that a function moves", makeRipples, {.shape = shapeRipples}},
    {"canopy", "alpha-masked leaves in the wind", makeCanopy, {.shape = shapeCanopy}},
    {"panes", "see-through surfaces, also in mirrors", makePanes, kSideways},
    {"thin-walls", "walls thinner than ten centimeters", makeThinWalls, kSideways},
    {"one-mesh", "a house with rooms that is one mesh", makeOneMesh, kSideways},
    {"ribbons", "thin features with one side", makeRibbons, kSideways},
}};

}  // namespace

std::span<const FailureScene> failureScenes() { return kFailures; }

}  // namespace halfsilver
