// Poses on the GPU against those of pose.h: the same vertices and windings, and bounds that hold them.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <halfsilver/gl/profiler.h>
#include <halfsilver/io.h>
#include "frame/gpu_rig.h"
#include "frame/gpu_scene.h"
#include "gpu/posed_models.h"
#include "gpu/tracing_scenes.h"
#include "passes/pose.h"
#include "shared_scenes.h"

namespace halfsilver::testing {
namespace {

bool contains(const Bounds& outer, const glm::vec3& point) {
  return glm::all(glm::lessThanEqual(outer.low, point)) && glm::all(glm::lessThanEqual(point, outer.high));
}

// A model on the GPU, without a renderer around it.
struct Posed {
  Posed(const gl::Api& wanted, const Model& model)
      : api(wanted),
        rig(wanted, model),
        scene(uploadScene(wanted, model.scene, posedParts(model, animatedBounds(model).instances))),
        pass(wanted) {}

  // Returns whether the pass had something to place.
  bool take(const PoseState& state, Posing posing = Posing::gpu) {
    change = {};
    rig.take(state, scene, change);
    const bool waited = rig.waiting();
    gl::Profiler untimed(api);
    pass.run(rig, scene, posing, untimed);
    return waited;
  }
  std::vector<glm::vec3> positions() const { return scene.positions.read<glm::vec3>(scene.vertexCount); }
  std::vector<shared::VertexAttributes> attributes() const {
    return scene.attributes.read<shared::VertexAttributes>(scene.vertexCount);
  }

  const gl::Api& api;
  GpuRig rig;
  GpuScene scene;
  PosePass pass;
  GpuRig::Change change;
};

struct Differences {
  double distance = 0;  // of positions, meters
  double angle = 0;     // of normals, degrees
  std::size_t signs = 0, triangles = 0;
};

Differences compare(const Posed& posed, const Model& model) {
  const std::vector<glm::vec3> positions = posed.positions();
  const std::vector<shared::VertexAttributes> attributes = posed.attributes();
  Differences found;
  for (const Instance& instance : model.rig.instances)
    for (std::uint32_t v = instance.firstVertex; v < instance.firstVertex + instance.vertexCount; ++v) {
      const Vertex& vertex = model.scene.vertices[v];
      found.distance = std::max<double>(found.distance, glm::distance(positions[v], vertex.position));
      const glm::dvec3 a = attributes[v].normal, b = vertex.normal;
      found.angle = std::max(found.angle, glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b))));
      found.signs += attributes[v].bitangentSign != vertex.tangent.w;
    }
  const auto triangles = posed.scene.triangles.read<glm::uvec4>(posed.scene.triangleCount);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      found.triangles += triangles[t][k] != model.scene.triangles[t].vertices[static_cast<std::size_t>(k)];
  return found;
}

void expectHeld(const Posed& posed, const Model& model) {
  const std::vector<glm::vec3> positions = posed.positions();
  const auto& clusters = posed.scene.clusters;
  for (const DrawCluster& cluster : clusters.all())
    for (std::uint32_t i = cluster.first; i < cluster.first + cluster.count; ++i)
      for (const std::uint32_t vertex : model.scene.triangles[clusters.drawList()[i]].vertices) {
        ASSERT_TRUE(contains(cluster.bounds, positions[vertex]));
        ASSERT_TRUE(contains(posed.scene.extents.bounds(), positions[vertex]));
      }
}

class GpuPose : public TracingTest {
 protected:
  void expectAsInDoubles(Model model, const std::string& name, Posing posing = Posing::gpu) {
    Posed posed(api, model);
    const Bounds bounds = posed.scene.extents.bounds();
    const double diagonal = static_cast<double>(bounds.diagonal());
    bool moved = false;
    for (const double time : kTimes) {
      const PoseState state = poseOf(model, time * durationOf(model));
      EXPECT_TRUE(posed.take(state, posing) || time > 0) << name;
      moved |= time > 0 && !posed.change.scene.moved.empty();
      pose(model, state);
      const Differences found = compare(posed, model);
      const bool exact = posing == Posing::cpu;
      EXPECT_LE(found.distance, exact ? 0 : GpuRig::kTolerance * diagonal) << name << " at " << time;
      EXPECT_LE(found.angle, exact ? 0 : 0.05) << name << " at " << time;
      EXPECT_EQ(found.signs, 0u) << name << " at " << time;
      EXPECT_EQ(found.triangles, 0u) << name << " at " << time;
      expectHeld(posed, model);
      EXPECT_EQ(posed.scene.extents.bounds().low, bounds.low) << name << ": the grid does not jump";
      EXPECT_EQ(posed.scene.extents.bounds().high, bounds.high) << name << ": the grid does not jump";
    }
    EXPECT_TRUE(moved) << name;
  }
};

TEST_F(GpuPose, PlacesVerticesAsDoublesDo) {
  for (const char* name : {"fox", "rigged_figure", "box_animated", "animated_morph_cube", "milk_truck", "desk_fan"}) {
    const std::filesystem::path file = sharedScene(std::string(name) + ".glb");
    HALFSILVER_REQUIRE_SCENE(file);
    expectAsInDoubles(loadGltf(file.string()), name);
  }
}

TEST_F(GpuPose, FollowsMirrorsAndWhatComesOutOfNothing) {
  for (const char* name :
       {"b01_animated_mirror", "b01_unmirrored_by_animation", "b03_joint_from_zero", "b03_morph_from_nothing",
        "b03_scale_from_zero", "b03_scale_from_zero_alone", "b04_step_tenths", "b05_slide_0.4", "b45_two_animations"}) {
    HALFSILVER_REQUIRE_SCENE(sharedCase(name));
    for (const Posing posing : {Posing::gpu, Posing::cpu})
      expectAsInDoubles(loadGltf(sharedCase(name).string()), name, posing);
  }
}

TEST_F(GpuPose, EveryKindOfInstanceIsPlacedAsInDoubles) {
  // Rigid or skinned, with morph targets or without, with normals or flat, and mirrored later on.
  Model model = rigged();
  for (Instance& instance : model.rig.instances)
    instance.targets = {{std::vector<glm::vec3>(3, {0.2f, 0, 0.1f}), {}, {}}};
  for (const int k : {0, 1, 2}) {
    const std::size_t from = static_cast<std::size_t>(k);
    Instance copy = model.rig.instances[from];
    copy.flatNormals = true;
    if (k > 0) copy.targets.clear();
    copy.firstVertex = static_cast<std::uint32_t>(model.scene.vertices.size());
    copy.firstTriangle = static_cast<std::uint32_t>(model.scene.triangles.size());
    addTriangle(model.scene, glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), 0);
    model.rig.instances.push_back(copy);
  }
  model.rig.nodes[0].weights = model.rig.nodes[1].weights = {0.5f};
  Animation animation{"mirror", 1, {}};
  for (const int node : {0, 1, 2, 3})
    animation.channels.push_back(
        {node, AnimatedProperty::scale, Interpolation::linear, {0, 1}, {1, 1, 1, -1, 1.5f, 0.5f}});
  model.rig.animations = {animation};
  pose(model, evaluate(model.rig, {}));
  for (const Posing posing : {Posing::gpu, Posing::cpu}) expectAsInDoubles(model, "all kinds", posing);
}

TEST_F(GpuPose, OnlyWhatMovesIsPlacedAgain) {
  Model model = rigged();
  Posed posed(api, model);
  EXPECT_TRUE(posed.take(evaluate(model.rig, {})));
  ASSERT_EQ(posed.change.scene.moved.size(), 1u) << "the first pose places all";
  EXPECT_EQ(posed.change.scene.moved[0].count, 9u);
  EXPECT_FALSE(posed.take(evaluate(model.rig, {})));
  EXPECT_FALSE(posed.change.scene.any());
  EXPECT_TRUE(posed.change.touched.empty());
  model.rig.nodes[1].translation.y = 0.5;
  EXPECT_TRUE(posed.take(evaluate(model.rig, {})));
  ASSERT_EQ(posed.change.scene.moved.size(), 1u);
  EXPECT_EQ(posed.change.scene.moved[0].first, 3u);
  EXPECT_EQ(posed.change.scene.moved[0].count, 3u);
  EXPECT_EQ(posed.change.touched.size(), 2u) << "before and after";
  EXPECT_EQ(posed.positions()[3], glm::vec3(2, 0.5f, 0));
}

TEST_F(GpuPose, BoundsFollowFromThePoseAloneWhateverCameBefore) {
  Model model = rigged();
  const auto at = [&](double height) {
    model.rig.nodes[1].translation = {0, height, 0};
    return evaluate(model.rig, {});
  };
  Posed wandered(api, model), straight(api, model);
  for (const double height : {40.0, -7.0, 0.0}) wandered.take(at(height));
  const Bounds usual = straight.scene.extents.bounds();
  EXPECT_EQ(wandered.scene.extents.bounds().high, usual.high);
  EXPECT_EQ(wandered.scene.extents.bounds().low, usual.low);
  for (const double height : {5.0, 5.001}) {
    wandered.take(at(height));
    straight.take(at(height));
    EXPECT_EQ(wandered.scene.extents.bounds().high, straight.scene.extents.bounds().high);
    EXPECT_EQ(wandered.scene.extents.core().bounds.high, straight.scene.extents.core().bounds.high);
    EXPECT_GT(straight.scene.extents.bounds().high.y, 6);
  }
}

TEST_F(GpuPose, APoseBeyondAllAnimationsWidensTheBounds) {
  Model model = rigged();
  Posed posed(api, model);
  model.rig.nodes[1].translation = {0, 40, 0};
  const PoseState state = evaluate(model.rig, {});
  posed.take(state);
  pose(model, state);
  expectHeld(posed, model);
  EXPECT_GE(posed.scene.extents.bounds().high.y, 41);
  EXPECT_GE(posed.scene.extents.core().bounds.high.y, 41);
}

TEST_F(GpuPose, RestPositionsFarAwayKeepTheirPrecision) {
  // Floats there are 1/32 m apart; the node brings them back.
  Model model = rigged(glm::dvec3(4e5, 0, 0));
  for (Node& node : model.rig.nodes) node.translation.x = -4e5;
  PoseState state = evaluate(model.rig, {});
  pose(model, state);  // so that the scene is as large as it is drawn
  Posed posed(api, model);
  state.world[1][3].y += 0.3;
  EXPECT_TRUE(posed.take(state));
  pose(model, state);
  EXPECT_LE(compare(posed, model).distance, GpuRig::kTolerance * 7);
}

TEST_F(GpuPose, WhatFloatsCannotPlaceIsPlacedInDoubles) {
  const auto expectInDoubles = [this](Model model, const PoseState& state, const char* what) {
    Posed posed(api, model);
    posed.take(evaluate(model.rig, {}));
    EXPECT_FALSE(posed.take(state)) << what;
    EXPECT_FALSE(posed.change.scene.moved.empty()) << what;
    pose(model, state);
    const Differences found = compare(posed, model);
    EXPECT_EQ(found.distance, 0) << what;
    EXPECT_EQ(found.angle, 0) << what;
  };
  const Model far = rigged(glm::dvec3(1e6, 0, 0));
  PoseState state = evaluate(far.rig, {});
  state.world[1][3].y = 0.3;
  expectInDoubles(far, state, "far from the origin");
  const Model model = rigged();
  state = evaluate(model.rig, {});
  state.world[1] =
      glm::dmat4(glm::dvec4(1, 1, 0, 0), glm::dvec4(1, 1 + 1e-9, 0, 0), glm::dvec4(0, 0, 1, 0), glm::dvec4(0, 0, 0, 1));
  expectInDoubles(model, state, "nearly flat");
}

TEST_F(GpuPose, WhatTheCallerTurnsLeavesTheWindingOfPosesAlone) {
  Model model = rigged();
  addTriangle(model.scene, glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), 0);
  const auto still = static_cast<std::uint32_t>(model.scene.triangles.size() - 1);
  Posed posed(api, model);
  model.rig.nodes[1].scale.x = -1;
  posed.take(evaluate(model.rig, {}));
  std::swap(model.scene.triangles[still].vertices[1], model.scene.triangles[still].vertices[2]);
  updateScene(api, posed.scene, model.scene, {.moved = {{3 * still, 3}}, .turned = {{still, 1}}});
  const auto triangles = posed.scene.triangles.read<glm::uvec4>(posed.scene.triangleCount);
  const std::vector<glm::uvec4> expected = {{0, 1, 2, 0}, {3, 5, 4, 0}, {6, 7, 8, 0}, {9, 11, 10, 0}};
  EXPECT_EQ(triangles, expected);
  EXPECT_EQ(posed.scene.indices.read<glm::uvec3>(4),
            (std::vector<glm::uvec3>{{0, 1, 2}, {3, 5, 4}, {6, 7, 8}, {9, 11, 10}}));
}

TEST_F(GpuPose, ManyMorphTargetsAreAsExactAsFew) {
  // Each sum is 0.6 of the distance of two floats more than the one before, so it rounds up.
  constexpr float kFar = 1024, kStep = 0.6f / 8192;
  Model model = rigged();
  Instance& instance = model.rig.instances[0];
  const auto add = [&instance](float x) { instance.targets.push_back({std::vector<glm::vec3>(3, {x, 0, 0}), {}, {}}); };
  add(kFar);
  for (int i = 0; i < 1000; ++i) add(kStep);
  add(-kFar);
  model.rig.nodes[0].weights.assign(instance.targets.size(), 1);
  const PoseState state = evaluate(model.rig, {});
  pose(model, state);
  EXPECT_NEAR(model.scene.vertices[0].position.x, 1000 * kStep, 1e-4);
  Posed posed(api, model);
  posed.take(state);
  const double diagonal = static_cast<double>(posed.scene.extents.bounds().diagonal());
  EXPECT_LE(compare(posed, model).distance, GpuRig::kTolerance * diagonal);
  // A few of them are left to the GPU.
  instance.targets.erase(instance.targets.begin() + 6, instance.targets.end());
  Posed few(api, model);
  few.take(evaluate(rigged().rig, {}));
  EXPECT_TRUE(few.take(state));
}

}  // namespace
}  // namespace halfsilver::testing
