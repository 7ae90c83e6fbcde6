#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include <halfsilver/pose.h>
#include "gltf_loading.h"
#include "shared_scenes.h"

namespace halfsilver::testing {
namespace {

// A triangle whose node follows one channel.
GltfFile animated(const char* path, const std::vector<float>& times, const std::vector<float>& values, const char* type,
                  const char* interpolation) {
  GltfFile file;
  file.triangle();
  const int input = file.accessor(times, "SCALAR"), output = file.accessor(values, type);
  const json sampler = {{"input", input}, {"output", output}, {"interpolation", interpolation}};
  const json channel = {{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}};
  file.add("animations", {{"samplers", json::array({sampler})}, {"channels", json::array({channel})}});
  return file;
}

glm::vec3 corner(const Model& model, std::size_t k) { return vertex(model, 0, k).position; }

SceneChange poseAt(Model& model, double seconds, int animation = 0) {
  const Playing playing{animation, seconds};
  return pose(model, std::span(&playing, 1));
}

TEST(Pose, StaticScenesDoNotMove) {
  GltfFile file;
  file.triangle();
  Model model = load(file);
  EXPECT_FALSE(pose(model, evaluate(model.rig, {})).any());
}

TEST(Pose, LinearTranslationInterpolatesAndLoops) {
  Model model = load(animated("translation", {0, 2}, {0, 0, 0, 4, 0, 0}, "VEC3", "LINEAR"));
  ASSERT_EQ(model.rig.instances.size(), 1u);
  const auto ranges = poseAt(model, 0.5).moved;
  ASSERT_EQ(ranges.size(), 1u);
  EXPECT_EQ(ranges[0].first, 0u);
  EXPECT_EQ(ranges[0].count, model.scene.vertices.size());
  EXPECT_TRUE(near(corner(model, 0), {1, 0, 0}));
  EXPECT_FALSE(poseAt(model, 0.5).any()) << "nothing changed since";
  poseAt(model, 2.5);
  EXPECT_TRUE(near(corner(model, 0), {1, 0, 0})) << "a loop later";
  poseAt(model, -1.5);
  EXPECT_TRUE(near(corner(model, 0), {1, 0, 0})) << "a loop earlier";
}

TEST(Pose, StepHoldsTheLastKey) {
  Model model = load(animated("scale", {0, 1, 2}, {1, 1, 1, 3, 1, 1, 5, 1, 1}, "VEC3", "STEP"));
  poseAt(model, 0.99);
  EXPECT_TRUE(near(corner(model, 1), {1, 0, 0}));
  poseAt(model, 1.01);
  EXPECT_TRUE(near(corner(model, 1), {3, 0, 0}));
}

TEST(Pose, AKeyHoldsFromTheFloatOfItsTimeOn) {
  std::vector<float> times, values;
  for (int tenth = 0; tenth <= 10; ++tenth) {
    times.push_back(static_cast<float>(tenth) / 10);
    values.insert(values.end(), {static_cast<float>(tenth), 0, 0});
  }
  Model model = load(animated("translation", times, values, "VEC3", "STEP"));
  for (int tenth = 0; tenth <= 10; ++tenth) {
    poseAt(model, tenth / 10.0);
    EXPECT_EQ(corner(model, 0).x, static_cast<float>(tenth));
  }
}

TEST(Pose, TheDurationIsTheLastPoseWhateverItIs) {
  for (const float duration : {0.1f, 0.4f, 0.9f, 1.0f, 3.3f, 100.7f}) {
    Model model = load(animated("translation", {0, duration}, {0, 0, 0, 4, 0, 0}, "VEC3", "LINEAR"));
    poseAt(model, std::stod(std::to_string(duration)));
    EXPECT_NEAR(corner(model, 0).x, 4, 1e-5f) << duration;
  }
}

TEST(Pose, EveryLoopEndsWithTheLastPoseAndHoldsItsKeys) {
  for (const int tenths : {1, 3, 4, 6, 7, 9, 13, 33}) {
    const double duration = tenths / 10.0;
    std::vector<float> times, values;
    for (int tenth = 0; tenth <= tenths; ++tenth) {
      times.push_back(std::stof(std::to_string(tenth / 10.0)));
      values.insert(values.end(), {static_cast<float>(tenth), 0, 0});
    }
    Model model = load(animated("translation", times, values, "VEC3", "STEP"));
    for (int tenth = 1; tenth < 5 * tenths; ++tenth) {
      poseAt(model, tenth / 10.0);
      const int inLoop = tenth % tenths == 0 ? tenths : tenth % tenths;
      EXPECT_EQ(corner(model, 0).x, static_cast<float>(inLoop)) << tenth << " tenths of " << duration << " s";
    }
    poseAt(model, 0);
    EXPECT_EQ(corner(model, 0).x, 0);
  }
}

TEST(Pose, KeysThatDoNotIncreaseFromZeroAreLeftOut) {
  const Model model = load(animated("translation", {-1, 0, 0, 2, 1, 3},
                                    {9, 9, 9, 0, 0, 0, 9, 9, 9, 2, 0, 0, 9, 9, 9, 3, 0, 0}, "VEC3", "LINEAR"));
  const Channel& channel = model.rig.animations.at(0).channels.at(0);
  EXPECT_EQ(channel.times, (std::vector<float>{0, 2, 3}));
  EXPECT_EQ(channel.values, (std::vector<float>{0, 0, 0, 2, 0, 0, 3, 0, 0}));
  const auto& warnings = model.warnings;
  EXPECT_EQ(std::count_if(warnings.begin(), warnings.end(),
                          [](const std::string& line) { return line.find("3 keys") != std::string::npos; }),
            1);
  EXPECT_TRUE(load(animated("translation", {-2, -1}, {9, 9, 9, 9, 9, 9}, "VEC3", "LINEAR"))
                  .rig.animations.at(0)
                  .channels.empty());
}

glm::vec3 facing(const Model& model, std::size_t triangle = 0) {
  const auto& corners = model.scene.triangles.at(triangle).vertices;
  const auto at = [&](std::size_t k) { return model.scene.vertices[corners[k]].position; };
  return glm::cross(at(1) - at(0), at(2) - at(0));
}

TEST(Pose, TrianglesTurnWhenAnAnimationMirrorsThem) {
  Model model = load(animated("scale", {0, 1}, {1, 1, 1, -1, 1, 1}, "VEC3", "LINEAR"));
  const std::size_t count = model.scene.triangles.size();
  EXPECT_TRUE(poseAt(model, 0.25).turned.empty());
  EXPECT_GT(facing(model).z, 0);
  const SceneChange change = poseAt(model, 0.75);
  ASSERT_EQ(change.turned.size(), 1u);
  EXPECT_EQ(change.turned[0].count, count);
  EXPECT_GT(facing(model).z, 0) << "what faced the viewer still does";
  EXPECT_GT(model.scene.vertices[0].normal.z, 0);
  EXPECT_TRUE(poseAt(model, 0.9).turned.empty());
  EXPECT_EQ(poseAt(model, 0.1).turned.size(), 1u);
  EXPECT_GT(facing(model).z, 0);
}

TEST(Pose, TrianglesWithoutAreaAtRestAreKeptIfTheyCanMove) {
  GltfFile file = animated("scale", {0, 1}, {0, 0, 0, 1, 1, 1}, "VEC3", "LINEAR");
  file.root["nodes"][0]["scale"] = {0, 0, 0};
  Model model = load(file);
  ASSERT_EQ(model.scene.triangles.size(), 1u) << "empty at rest, and loaded all the same";
  poseAt(model, 1);
  EXPECT_GT(facing(model).z, 0);
  file.root.erase("animations");
  EXPECT_THROW(load(file), Error) << "nothing will ever show";
}

TEST(Pose, AnimationsPlayTogetherUnlessTheyMoveTheSame) {
  Rig rig;
  rig.nodes.resize(3);
  const auto add = [&](std::vector<std::pair<int, AnimatedProperty>> moves) {
    Animation animation{"", 1, {}};
    for (const auto& [node, property] : moves)
      animation.channels.push_back({node, property, Interpolation::linear, {0, 1}, {0, 0, 0, 1, 1, 1}});
    rig.animations.push_back(animation);
  };
  add({{0, AnimatedProperty::translation}});
  add({{0, AnimatedProperty::scale}, {1, AnimatedProperty::translation}});
  add({{0, AnimatedProperty::scale}});
  add({{2, AnimatedProperty::translation}});
  EXPECT_EQ(compatibleAnimations(rig), (std::vector<int>{0, 1, 3}));
  const auto world = evaluate(rig, std::vector<Playing>{{0, 0.5}, {3, 0.25}}).world;
  EXPECT_EQ(glm::dvec3(world[0][3]), glm::dvec3(0.5));
  EXPECT_EQ(glm::dvec3(world[2][3]), glm::dvec3(0.25)) << "each at its own time";
  EXPECT_EQ(glm::dvec3(world[1][3]), glm::dvec3(0));
}

TEST(Pose, RotationTakesTheShorterWayAtEvenSpeed) {
  const float half = std::sqrt(0.5f);
  // The second quaternion is the rotation by 90 degrees with its sign flipped.
  Model model = load(animated("rotation", {0, 1}, {0, 0, 0, 1, 0, 0, -half, -half}, "VEC4", "LINEAR"));
  poseAt(model, 1.0 / 3);
  const float angle = glm::radians(30.0f);
  EXPECT_TRUE(near(corner(model, 1), {std::cos(angle), std::sin(angle), 0}));
}

TEST(Pose, CubicSplineFollowsHermite) {
  // Key 0: value 0, leaving at 2 per second; key 1 at 2 s: value 1, arriving at -1 per second.
  Model model = load(
      animated("translation", {0, 2}, {9, 9, 9, 0, 0, 0, 2, 0, 0, -1, 0, 0, 1, 0, 0, 9, 9, 9}, "VEC3", "CUBICSPLINE"));
  poseAt(model, 0.5);
  const double t = 0.25, t2 = t * t, t3 = t2 * t;
  const double expected = 2 * (t3 - 2 * t2 + t) * 2 + (3 * t2 - 2 * t3) * 1 + 2 * (t3 - t2) * -1;
  EXPECT_NEAR(corner(model, 0).x, expected, 1e-6);
}

TEST(Pose, BeforeTheFirstKeyItHolds) {
  Model model = load(animated("translation", {1, 2}, {5, 0, 0, 6, 0, 0}, "VEC3", "LINEAR"));
  poseAt(model, 0.25);
  EXPECT_TRUE(near(corner(model, 0), {5, 0, 0}));
}

TEST(Pose, ChildrenCamerasAndLightsFollow) {
  GltfFile file = animated("translation", {0, 1}, {0, 0, 0, 0, 8, 0}, "VEC3", "LINEAR");
  file.root["nodes"][0].erase("mesh");
  file.root["nodes"][0]["children"] = {1, 2};
  file.add("nodes", {{"mesh", 0}, {"translation", {1, 0, 0}}});
  file.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
  file.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  file.add("nodes", {{"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  Model model = load(file);
  poseAt(model, 0.5);
  EXPECT_TRUE(near(corner(model, 0), {1, 4, 0}));
  EXPECT_TRUE(near(model.scene.cameras.at(0).eye, {0, 4, 0}));
  EXPECT_TRUE(near(model.scene.lights.at(0).position, {0, 4, 0}));
}

TEST(Pose, ARectangleLightTurnsWithItsNode) {
  const float half = std::sqrt(0.5f);
  // About the light's own direction: only its upper edge moves.
  GltfFile file = animated("rotation", {0, 1}, {0, 0, 0, 1, 0, 0, half, half}, "VEC4", "LINEAR");
  file.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  file.root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  Model model = load(file);
  model.scene.lights.at(0).type = LightType::rectangle;
  poseAt(model, 0);
  EXPECT_TRUE(near(model.scene.lights[0].up, {0, 1, 0}));
  const SceneChange change = poseAt(model, 0.5);
  EXPECT_TRUE(near(model.scene.lights[0].up, {-half, half, 0}));
  EXPECT_TRUE(near(model.scene.lights[0].direction, {0, 0, -1}));
  EXPECT_TRUE(change.lights);
}

TEST(Pose, MorphTargetsAddUp) {
  GltfFile file = animated("weights", {0, 1}, {0, 0, 1, 0.5f}, "SCALAR", "LINEAR");
  const int up = file.accessor(std::vector<float>{0, 0, 0, 0, 2, 0, 0, 0, 0}, "VEC3");
  const int out = file.accessor(std::vector<float>{0, 0, 0, 0, 0, 4, 0, 0, 0}, "VEC3");
  file.root["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", up}}, {{"POSITION", out}}};
  file.root["meshes"][0]["weights"] = {0.25, 0};
  Model model = load(file);
  EXPECT_TRUE(near(corner(model, 1), {1, 0.5f, 0})) << "the mesh's weights at rest";
  poseAt(model, 0.5);
  EXPECT_TRUE(near(corner(model, 1), {1, 1, 1}));
  // A primitive without normals is flat in every shape.
  const glm::vec3 a = corner(model, 0);
  const glm::vec3 flat = glm::normalize(glm::cross(corner(model, 1) - a, corner(model, 2) - a));
  for (const Vertex& vertex : model.scene.vertices) EXPECT_TRUE(near(vertex.normal, flat));
}

TEST(Pose, SkinBlendsJointsAndIgnoresItsNode) {
  GltfFile file = animated("translation", {0, 1}, {0, 0, 0, 0, 6, 0}, "VEC3", "LINEAR");
  json& node = file.root["nodes"][0];
  node.erase("mesh");  // the animated node becomes the second joint
  json& attributes = file.root["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = file.accessor(std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4");
  // Weights that do not sum to one: 2 + 4 make a third and two thirds.
  attributes["WEIGHTS_0"] = file.accessor(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 2, 4, 0, 0}, "VEC4");
  const int bind = file.accessor(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,
                                                    1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 7, 1},
                                 "MAT4");
  const int still = file.add("nodes", json::object());
  file.add("nodes", {{"mesh", 0}, {"skin", 0}, {"translation", {100, 100, 100}}});
  file.add("skins", {{"joints", {still, 0}}, {"inverseBindMatrices", bind}});
  Model model = load(file);
  ASSERT_EQ(model.rig.instances.size(), 1u);
  EXPECT_TRUE(near(corner(model, 1), {1, 0, 7})) << "the second joint's inverse bind matrix";
  poseAt(model, 0.5);
  EXPECT_TRUE(near(corner(model, 0), {0, 0, 0}));
  EXPECT_TRUE(near(corner(model, 1), {1, 3, 7}));
  EXPECT_TRUE(near(corner(model, 2), {0, 1 + 2, 14.0f / 3}));
}

TEST(Pose, EverySetOfJointsCounts) {
  GltfFile file = animated("translation", {0, 1}, {0, 0, 0, 0, 6, 0}, "VEC3", "LINEAR");
  file.root["nodes"][0].erase("mesh");
  json& attributes = file.root["meshes"][0]["primitives"][0]["attributes"];
  const int still = file.accessor(std::vector<std::uint8_t>(12, 0), "VEC4");
  const int moving = file.accessor(std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1}, "VEC4");
  const int half = file.accessor(std::vector<float>{0.5, 0, 0, 0, 0.5, 0, 0, 0, 0.25, 0, 0, 0}, "VEC4");
  const int last = file.accessor(std::vector<float>{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.75}, "VEC4");
  attributes["JOINTS_0"] = still;
  attributes["WEIGHTS_0"] = half;
  attributes["JOINTS_1"] = moving;
  attributes["WEIGHTS_1"] = half;
  attributes["JOINTS_2"] = moving;
  attributes["WEIGHTS_2"] = last;
  const int rest = file.add("nodes", json::object());
  file.add("nodes", {{"mesh", 0}, {"skin", 0}});
  file.add("skins", {{"joints", {rest, 0}}});
  Model model = load(file);
  ASSERT_EQ(model.rig.instances.size(), 1u);
  EXPECT_EQ(model.rig.instances[0].jointSets, 3u);
  poseAt(model, 0.5);
  EXPECT_TRUE(near(corner(model, 0), {0, 0, 0}));
  EXPECT_TRUE(near(corner(model, 1), {1, 1.5f, 0})) << "half by a joint of the second set";
  EXPECT_TRUE(near(corner(model, 2), {0, 1 + 3 * 0.6f, 0})) << "of weights whose sum is 1.25, 0.75 in the third set";
}

// Frames of a clip that is a whole number of frames long, whatever loop they are in.
TEST(Pose, LoopsDoNotDriftInAnHour) {
  for (const int fps : {24, 25, 30, 48, 60})
    for (const int frames : {7, 10, 32, 65, 100}) {
      std::vector<float> times, values;
      for (int frame = 0; frame <= frames; ++frame) {
        times.push_back(static_cast<float>(static_cast<double>(frame) / fps));
        values.insert(values.end(), {static_cast<float>(frame), 0, 0});
      }
      Model model = load(animated("translation", times, values, "VEC3", "STEP"));
      int wrong = 0;
      for (int frame = 3600 * fps - 2 * frames; frame < 3600 * fps + 2 * frames; ++frame) {
        poseAt(model, static_cast<double>(frame) / fps);
        const int expected = frame % frames == 0 ? frames : frame % frames;
        wrong += !near(corner(model, 0) + glm::vec3(model.scene.origin), {static_cast<float>(expected), 0, 0});
      }
      EXPECT_EQ(wrong, 0) << fps << " fps, " << frames << " frames";
    }
}

TEST(Pose, WithoutLoopsTheEndsHold) {
  Model model = load(animated("translation", {0, 2}, {0, 0, 0, 4, 0, 0}, "VEC3", "LINEAR"));
  const auto at = [&](double seconds) {
    const Playing playing{.animation = 0, .seconds = seconds, .loop = false};
    pose(model, std::span(&playing, 1));
    return corner(model, 0).x;
  };
  EXPECT_FLOAT_EQ(at(0.5), 1);
  EXPECT_FLOAT_EQ(at(2), 4);
  EXPECT_FLOAT_EQ(at(2.5), 4);
  EXPECT_FLOAT_EQ(at(3600), 4);
  EXPECT_FLOAT_EQ(at(-1), 0);
}

TEST(Pose, FarScenesMoveWithDoublePrecision) {
  GltfFile file = animated("translation", {0, 1}, {0, 0, 0, 0.001f, 0, 0}, "VEC3", "LINEAR");
  file.add("nodes", {{"translation", {1e7, 0, 0}}, {"children", {0}}});
  Model model = load(file);
  const float before = corner(model, 0).x;
  poseAt(model, 0.5);
  EXPECT_NEAR(corner(model, 0).x - before, 0.0005f, 1e-6) << "a float at 1e7 m steps by one meter";
}

TEST(Pose, UnknownAnimationsAndTimesAreRefused) {
  Model model = load(animated("translation", {0, 1}, {0, 0, 0, 1, 0, 0}, "VEC3", "LINEAR"));
  EXPECT_THROW(poseAt(model, 0, 1), Error);
  EXPECT_THROW(poseAt(model, std::nan("")), Error);
}

TEST(Pose, AnimationsThatLeaveTheRangeOfFloatsAreRefused) {
  GltfFile file = animated("translation", {0, 1}, {0, 0, 0, 3e38f, 0, 0}, "VEC3", "LINEAR");
  file.root["nodes"][0]["scale"] = {1, 1, 1};
  file.add("nodes", {{"scale", {10, 1, 1}}, {"children", {0}}});
  Model model = load(file);
  EXPECT_THROW(poseAt(model, 0.9), Error);
}

TEST(Pose, WorldMatricesAreThoseOfTheHierarchy) {
  GltfFile file = animated("translation", {0, 1}, {0, 0, 0, 0, 8, 0}, "VEC3", "LINEAR");
  file.add("nodes", {{"scale", {2, 2, 2}}, {"children", {0}}});
  const Model model = load(file);
  const Playing playing{0, 0.5};
  const auto world = evaluate(model.rig, std::span(&playing, 1)).world;
  ASSERT_EQ(world.size(), 2u);
  EXPECT_EQ(glm::dvec3(world[1][3]), glm::dvec3(0, 8, 0)) << "parents first";
}

// Real files: at every time positions are finite, normals have unit length and the size is plausible.
class PoseOfScene : public ::testing::TestWithParam<const char*> {};

TEST_P(PoseOfScene, StaysSane) {
  const auto path = sharedScene(std::string(GetParam()) + ".glb");
  HALFSILVER_REQUIRE_SCENE(path);
  Model model = loadGltf(path);
  const float size = model.scene.bounds().diagonal();
  const std::vector<Vertex> rest = model.scene.vertices;
  ASSERT_FALSE(model.rig.instances.empty());
  std::size_t changes = 0;
  for (int animation = 0; animation < static_cast<int>(model.rig.animations.size()); ++animation)
    for (const double part : {0.0, 0.13, 0.5, 0.77, 1.4}) {
      const auto& played = model.rig.animations[static_cast<std::size_t>(animation)];
      changes += poseAt(model, part * static_cast<double>(played.duration), animation).moved.size();
      const Bounds bounds = model.scene.bounds();
      for (const Vertex& vertex : model.scene.vertices) {
        ASSERT_LT(glm::length(vertex.position - bounds.center()), 20 * size);
        ASSERT_NEAR(glm::length(vertex.normal), 1, 1e-4);
        ASSERT_NEAR(glm::length(glm::vec3(vertex.tangent)), 1, 1e-4);
      }
      EXPECT_GT(bounds.diagonal(), 0.2f * size) << played.name << " at " << part;
      EXPECT_LT(bounds.diagonal(), 8 * size) << played.name << " at " << part;
    }
  EXPECT_GT(changes, 1u);
  pose(model, evaluate(model.rig, {}));
  for (std::size_t i = 0; i < rest.size(); ++i)
    ASSERT_TRUE(near(rest[i].position, model.scene.vertices[i].position, 0));
}

INSTANTIATE_TEST_SUITE_P(Shared, PoseOfScene,
                         ::testing::Values("fox", "rigged_figure", "box_animated", "animated_morph_cube", "desk_fan",
                                           "milk_truck"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace halfsilver::testing
