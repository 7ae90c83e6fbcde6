// Poses on the GPU against those of pose.h: the same vertices, windings and pictures, and bounds that hold them.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <halfsilver/error.h>
#include <halfsilver/gl/profiler.h>
#include <halfsilver/io.h>
#include "frame/gpu_rig.h"
#include "frame/gpu_scene.h"
#include "gpu/binding_audit.h"
#include "gpu/tracing_scenes.h"
#include "passes/pose.h"
#include "scene/posed_bounds.h"
#include "shared_scenes.h"

namespace halfsilver::testing {
namespace {

constexpr double kTimes[] = {0, 0.13, 0.37, 0.61, 1};  // of the longest animation

PoseState poseOf(const Model& model, double seconds) {
  return evaluate(model.rig, playTogether(compatibleAnimations(model.rig), seconds));
}

double durationOf(const Model& model) {
  double duration = 0;
  for (const Animation& animation : model.rig.animations)
    duration = std::max(duration, static_cast<double>(animation.duration));
  return duration;
}

std::filesystem::path sharedCase(const std::string& name) {
  return sharedScene("").parent_path().parent_path() / "cases" / (name + ".gltf");
}

bool contains(const Bounds& outer, const glm::vec3& point) {
  return glm::all(glm::lessThanEqual(outer.low, point)) && glm::all(glm::lessThanEqual(point, outer.high));
}

// A model on the GPU, without a renderer around it.
struct Posed {
  Posed(const gl::Api& wanted, const Model& model)
      : api(wanted), rig(wanted, model), scene(uploadScene(wanted, model.scene, posedParts(model))), pass(wanted) {}

  // Returns whether the pass had something to place.
  bool take(const PoseState& state, Posing posing = Posing::gpu) {
    change = rig.take(state, scene);
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

TEST_F(GpuPose, DrawsTheCasesAsPosesOnTheCpuDo) {
  const struct {
    const char* name;
    double seconds;
    float depth;  // at the center; 0: not asked
  } cases[] = {{"b01_animated_mirror", 0, 2.5f},
               {"b01_animated_mirror", 1.5, 2.5f},
               {"b01_unmirrored_by_animation", 0, 2.5f},
               {"b01_unmirrored_by_animation", 1.5, 2.5f},
               {"b02_skin_mirrored_armature", 0, 2.5f},
               {"b02_skin_plain_armature", 0, 2.5f},
               {"b03_scale_from_zero", 1.5, 2.5f},
               {"b03_morph_from_nothing", 1.5, 2.5f},
               {"b03_joint_from_zero", 1.5, 2.5f},
               {"b03_scale_from_zero_alone", 1.5, 2.5f},
               {"b04_step_tenths", 0.3, 0},
               {"b05_slide_0.4", 0.4f, 0},
               {"b05_slide_0.9", 0.9f, 0},
               {"b45_two_animations", 1.5, 0}};
  for (const auto& each : cases) {
    HALFSILVER_REQUIRE_SCENE(sharedCase(each.name));
    Model model = loadGltf(sharedCase(each.name).string());
    const PoseState state = poseOf(model, each.seconds);
    const Camera camera = posedCamera(model, state, 0);
    Model truth = model;
    pose(truth, state);
    const Settings none = settingsWith({{"select.mode", "none"}});
    const std::vector<float> right = draw(truth.scene, camera, none, 160, 90).plane("depth.Z");
    Renderer posed = makeRenderer(model.scene);
    for (const char* posing : {"gpu", "cpu"}) {
      posed.setModel(model);
      posed.pose(state);
      const Settings settings = settingsWith({{"select.mode", "none"}, {"scene.posing", posing}});
      const std::vector<float> depth = drawWith(posed, camera, settings, 160, 90).plane("depth.Z");
      std::size_t covered = 0, wrong = 0;
      for (std::size_t i = 0; i < depth.size(); ++i) {
        covered += right[i] > 0;
        wrong += std::abs(depth[i] - right[i]) > 1e-4f;
      }
      EXPECT_GT(covered, 20u) << each.name;
      EXPECT_EQ(wrong, 0u) << each.name << " at " << each.seconds << ", " << posing;
      if (each.depth > 0) {
        EXPECT_NEAR(depth[45 * 160 + 80], each.depth, 1e-4f) << each.name << " at " << each.seconds << ", " << posing;
      }
    }
  }
}

// A mirror below the model.
void addFloor(Model& model, const Bounds& bounds) {
  const glm::vec3 low = bounds.low - 0.2f * bounds.extent(), high = bounds.high + 0.2f * bounds.extent();
  const auto material = static_cast<std::uint32_t>(model.scene.materials.size());
  model.scene.materials.push_back(mirrorMaterial());
  addTriangle(model.scene, {low.x, low.y, low.z}, {low.x, low.y, high.z}, {high.x, low.y, high.z}, material);
  addTriangle(model.scene, {low.x, low.y, low.z}, {high.x, low.y, high.z}, {high.x, low.y, low.z}, material);
}

TEST_F(GpuPose, RaysOfAllMethodsSeeTheSameTriangles) {
  for (const char* name : {"fox", "rigged_figure", "box_animated", "animated_morph_cube", "milk_truck", "desk_fan"}) {
    const std::filesystem::path file = sharedScene(std::string(name) + ".glb");
    HALFSILVER_REQUIRE_SCENE(file);
    Model model = loadGltf(file.string());
    for (Material& material : model.scene.materials) material.mirror = 0.5f;
    addFloor(model, instanceBounds(model).front());
    const Camera camera = frameAll(model.scene.bounds());
    Settings exact = settingsWith({{"trace.method", "exact"}, {"select.mode", "all"}}), identity = exact, bvh = exact;
    set(identity, "trace.method", "identity");
    set(bvh, "trace.method", "bvh");
    Renderer renderers[] = {makeRenderer(model.scene), makeRenderer(model.scene), makeRenderer(model.scene)};
    for (Renderer& renderer : renderers) renderer.setModel(model);
    for (const double time : kTimes) {
      for (Renderer& renderer : renderers) renderer.pose(poseOf(model, time * durationOf(model)));
      const Frame truth = drawWith(renderers[0], camera, exact, 96, 54);
      const Frame own = drawWholeWith(renderers[1], camera, identity, 96, 54);
      const std::vector<float> hits = truth.plane("hit.T");
      EXPECT_GT(std::count_if(hits.begin(), hits.end(), [](float t) { return t > 0; }), 10) << name;
      for (const Frame& frame : {own, drawWholeWith(renderers[2], camera, bvh, 96, 54)}) {
        const HitErrors errors = compareHits(frame, truth, model.scene.bounds().diagonal());
        EXPECT_EQ(errors.hitError, 0) << name << " at " << time;
        // The boxes of box_animated touch: of two triangles at one place either is right.
        if (std::string(name) != "box_animated") {
          EXPECT_EQ(errors.wrongId, 0) << name << " at " << time;
        }
      }
    }
  }
}

// Two instances of a triangle each, of which node 1 moves the second; a third of two joints.
Model rigged(const glm::dvec3& restOffset = glm::dvec3(0)) {
  Model model;
  model.scene.materials = {plain(glm::vec3(0.5f))};
  model.rig.nodes.resize(4);
  model.rig.skins.push_back({{2, 3}, {glm::dmat4(1), glm::dmat4(1)}});
  for (const int node : {0, 1, 2}) {
    Instance instance;
    instance.node = node;
    instance.firstVertex = static_cast<std::uint32_t>(model.scene.vertices.size());
    instance.firstTriangle = static_cast<std::uint32_t>(model.scene.triangles.size());
    instance.vertexCount = 3;
    instance.triangleCount = 1;
    const glm::vec3 corner = glm::vec3(restOffset) + glm::vec3(2.0f * static_cast<float>(node), 0, 0);
    addTriangle(model.scene, corner, corner + glm::vec3(1, 0, 0), corner + glm::vec3(0, 1, 0), 0);
    instance.rest.assign(model.scene.vertices.end() - 3, model.scene.vertices.end());
    if (node == 2) {
      instance.skin = 0;
      instance.joints.assign(3, glm::uvec4(0, 1, 0, 0));
      instance.weights.assign(3, glm::vec4(0.5f, 0.5f, 0, 0));
    }
    model.rig.instances.push_back(instance);
  }
  model.scene.cameras = {lookAt({2, 0.5f, 6}, {2, 0.5f, 0})};
  return model;
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

TEST_F(GpuPose, LightsFollowTheirNodesAndKeepWhatThePlayerSets) {
  Model model = rigged();
  Light light;
  light.type = LightType::point;
  light.intensity = 40;
  light.position = {2, 1, 3};
  model.scene.lights = {light};
  model.rig.nodes.emplace_back().translation = {2, 1, 3};
  model.rig.lightNodes = {4};
  const Settings settings = settingsWith({{"select.mode", "none"}, {"shadow.sky_directions", "0"}});
  const Camera& camera = model.scene.cameras[0];
  Renderer renderer = makeRenderer(model.scene);
  renderer.setModel(model);
  const auto picture = [&] { return drawWith(renderer, camera, settings, 96, 54).plane("R"); };
  const auto truth = [&](Model posed) {
    pose(posed, evaluate(posed.rig, {}));
    return draw(posed.scene, camera, settings, 96, 54).plane("R");
  };
  const auto differing = [](const std::vector<float>& a, const std::vector<float>& b) {
    int count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += std::abs(a[i] - b[i]) > 0.02f * b[i];
    return count;
  };
  renderer.pose(evaluate(model.rig, {}));
  const std::vector<float> before = picture();
  model.rig.nodes[4].translation = {1, 0.5, 2};
  renderer.pose(evaluate(model.rig, {}));
  const std::vector<float> moved = picture();
  EXPECT_LT(differing(moved, truth(model)), 10);
  EXPECT_GT(differing(moved, before), 60);
  model.scene.lights[0].intensity = 80;  // the caller's copy is still where it was
  renderer.update(model.scene, {.lights = true});
  EXPECT_LT(differing(picture(), truth(model)), 10);
  EXPECT_GT(differing(picture(), moved), 60);
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

TEST_F(GpuPose, MotionVectorsFollow) {
  Model model = rigged();
  Renderer renderer = makeRenderer(model.scene);
  renderer.setModel(model);
  renderer.pose(evaluate(model.rig, {}));
  const Settings settings = settingsWith({{"select.mode", "none"}, {"image.motion", "true"}});
  const Camera& camera = model.scene.cameras[0];
  drawWith(renderer, camera, settings, 96, 54);
  model.rig.nodes[1].translation = {0.1, 0.05, 0};
  renderer.pose(evaluate(model.rig, {}));
  const Frame moved = drawWith(renderer, camera, settings, 96, 54);
  const double scale = 27 / std::tan(glm::radians(30.0)) / 6;  // pixels per meter
  const int x = 48 + static_cast<int>(0.4 * scale), y = 27 + static_cast<int>(0.1 * scale);
  ASSERT_GT(moved.at(x, y, "depth.Z"), 0);
  EXPECT_NEAR(moved.at(x, y, "motion.X"), 0.1 * scale, 1e-3);
  EXPECT_NEAR(moved.at(x, y, "motion.Y"), -0.05 * scale, 1e-3);
  const Frame still = drawWith(renderer, camera, settings, 96, 54);
  for (const char* channel : {"motion.X", "motion.Y"})
    for (const float value : still.plane(channel)) ASSERT_EQ(value, 0);
}

TEST_F(GpuPose, WhatIsWrongIsRefusedAndChangesNothing) {
  const auto refused = [](const auto& call) {
    try {
      call();
    } catch (const Error& error) {
      return error.kind();
    }
    ADD_FAILURE() << "was not refused";
    return ErrorKind::failed;
  };
  Model model = rigged();
  Renderer renderer = makeRenderer(model.scene);
  const PoseState rest = evaluate(model.rig, {});
  EXPECT_EQ(refused([&] { renderer.pose(rest); }), ErrorKind::usage) << "no model";
  renderer.setModel(model);
  EXPECT_EQ(refused([&] { renderer.pose({}); }), ErrorKind::usage) << "of another rig";
  PoseState lost = rest;
  lost.world[1][3].x = 1e300;
  EXPECT_EQ(refused([&] { renderer.pose(lost); }), ErrorKind::badInput);
  lost.world[1][3].x = std::nan("");
  EXPECT_EQ(refused([&] { renderer.pose(lost); }), ErrorKind::badInput);
  const VertexRange range{4, 1};
  EXPECT_EQ(refused([&] { renderer.updateVertices(model.scene, std::span(&range, 1)); }), ErrorKind::usage);
  const Settings settings = settingsWith({{"select.mode", "none"}});
  renderer.begin(model.scene.cameras[0], settings, 32, 18);
  EXPECT_EQ(refused([&] { renderer.pose(rest); }), ErrorKind::usage) << "a frame is under way";
  EXPECT_EQ(refused([&] { renderer.setModel(model); }), ErrorKind::usage);
  Model broken = rigged();
  broken.rig.instances[1].firstVertex = 8;
  Renderer other = makeRenderer(broken.scene);
  EXPECT_EQ(refused([&] { other.setModel(broken); }), ErrorKind::badInput);
}

TEST_F(GpuPose, MaterialsChangeWithoutALossOfWinding) {
  Model model = rigged();
  Renderer renderer = makeRenderer(model.scene);
  renderer.setModel(model);
  model.rig.nodes[1].scale.x = -1;
  model.rig.nodes[1].translation.x = 5;
  renderer.pose(evaluate(model.rig, {}));
  const Settings settings = settingsWith({{"select.mode", "none"}});
  const std::vector<float> before = drawWith(renderer, model.scene.cameras[0], settings, 96, 54).plane("depth.Z");
  EXPECT_GT(std::count_if(before.begin(), before.end(), [](float z) { return z > 0; }), 50);
  model.scene.materials[0].baseColor = {1, 0, 0, 1};
  renderer.update(model.scene, {.materials = true});
  EXPECT_EQ(drawWith(renderer, model.scene.cameras[0], settings, 96, 54).plane("depth.Z"), before);
}

TEST_F(GpuPose, BindsAllThatItReads) {
  const Model model = rigged();
  BindingAudit audit(context.getProcAddress());
  Renderer renderer(audit.getProcAddress());
  renderer.setModel(model);
  renderer.pose(evaluate(model.rig, {}));
  drawWith(renderer, model.scene.cameras[0], settingsWith({}), 64, 36);
  EXPECT_EQ(audit.checks("pose"), 2u) << "rigid and skinned";
  for (const std::string& complaint : audit.complaints()) ADD_FAILURE() << complaint;
}

}  // namespace
}  // namespace halfsilver::testing
