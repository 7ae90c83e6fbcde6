// The renderer with a model that it poses on the GPU: the same pictures, rays and lights as of a scene that was posed
// on the CPU, and what it refuses.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include <halfsilver/pose.h>
#include "gpu/binding_audit.h"
#include "gpu/posed_models.h"
#include "gpu/tracing_scenes.h"
#include "shared_scenes.h"

namespace halfsilver::testing {
namespace {

class PosedRenderer : public TracingTest {};

TEST_F(PosedRenderer, DrawsTheCasesAsPosesOnTheCpuDo) {
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

TEST_F(PosedRenderer, RaysOfAllMethodsSeeTheSameTriangles) {
  for (const char* name : {"fox", "rigged_figure", "box_animated", "animated_morph_cube", "milk_truck", "desk_fan"}) {
    const std::filesystem::path file = sharedScene(std::string(name) + ".glb");
    HALFSILVER_REQUIRE_SCENE(file);
    Model model = loadGltf(file.string());
    for (Material& material : model.scene.materials) material.mirror = 0.5f;
    addFloor(model, animatedBounds(model).instances.front());
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

TEST_F(PosedRenderer, LightsFollowTheirNodesAndKeepWhatThePlayerSets) {
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

TEST_F(PosedRenderer, MotionVectorsFollow) {
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

// What the renderer is asked to refuse.
template <class Call>
ErrorKind refused(const Call& call, std::string* message = nullptr) {
  try {
    call();
  } catch (const Error& error) {
    if (message) *message = error.what();
    return error.kind();
  }
  ADD_FAILURE() << "was not refused";
  return ErrorKind::failed;
}

// A model above a mirror, and a pose that lifts its first instance out of the bounds at rest and mirrors its second.
struct Mirrored {
  Mirrored() {
    addFloor(model, {{-1, -0.1f, -1}, {6, 1, 3}});
    model.rig.nodes[0].translation.y = 1.2;
    model.rig.nodes[1].scale.x = -1;
    model.rig.nodes[1].translation.x = 5;
    state = evaluate(model.rig, {});
    model.rig.nodes = rigged().rig.nodes;
    Model posed = model;
    pose(posed, state);
    truth = posed.scene;
  }

  Model model = rigged();
  PoseState state;
  Scene truth;  // in that pose
  Camera camera = lookAt({2, 0.8f, 5}, {2, 0.1f, 0});
  Settings settings = settingsWith({{"trace.method", "identity"}});
};

TEST_F(PosedRenderer, MaterialsChangeWithoutALossOfWinding) {
  Mirrored mirrored;
  Renderer renderer = makeRenderer(mirrored.model.scene);
  renderer.setModel(mirrored.model);
  renderer.pose(mirrored.state);
  const auto picture = [&] { return drawWholeWith(renderer, mirrored.camera, mirrored.settings, 96, 54); };
  const std::vector<float> before = picture().plane("hit.id");
  EXPECT_GT(std::count(before.begin(), before.end(), 1.0f), 5) << "the mirrored one, in the floor";
  // Another color leaves the draw list, two sides or a cut make another one.
  mirrored.model.scene.materials[0].baseColor = {1, 0, 0, 1};
  renderer.update(mirrored.model.scene, {.materials = true});
  EXPECT_EQ(picture().plane("hit.id"), before);
  mirrored.model.scene.materials[1].doubleSided = true;
  renderer.update(mirrored.model.scene, {.materials = true});
  const Frame after = picture();
  EXPECT_EQ(after.plane("hit.id"), before);
  const Frame truth = draw(mirrored.truth, mirrored.camera, mirrored.settings, 96, 54);
  EXPECT_EQ(after.plane("depth.Z"), truth.plane("depth.Z"));
}

TEST_F(PosedRenderer, WhatIsWrongIsRefusedAndChangesNothing) {
  const Mirrored mirrored;
  const Model& model = mirrored.model;
  Renderer renderer = makeRenderer(model.scene);
  const PoseState rest = evaluate(model.rig, {});
  EXPECT_EQ(refused([&] { renderer.pose(rest); }), ErrorKind::usage) << "no model";
  renderer.setModel(model);
  renderer.pose(mirrored.state);
  const auto picture = [&] { return drawWholeWith(renderer, mirrored.camera, mirrored.settings, 96, 54).layers.data; };
  const std::vector<float> before = picture();
  const auto expectRefused = [&](ErrorKind kind, const char* what, const auto& call) {
    EXPECT_EQ(refused(call), kind) << what;
    EXPECT_EQ(picture(), before) << what;
  };
  expectRefused(ErrorKind::usage, "a pose of another rig", [&] { renderer.pose({}); });
  PoseState lost = rest;
  for (const double far : {1e300, std::nan("")}) {
    lost.world[1][3].x = far;
    expectRefused(ErrorKind::badInput, "beyond floats", [&] { renderer.pose(lost); });
  }
  Scene other = model.scene;
  other.vertices[4].position.y += 0.5f;
  std::swap(other.triangles[1].vertices[1], other.triangles[1].vertices[2]);
  expectRefused(ErrorKind::usage, "a posed vertex", [&] { renderer.update(other, {.moved = {{4, 1}}}); });
  expectRefused(ErrorKind::usage, "a posed triangle", [&] {
    renderer.update(other, {.moved = {{9, 3}}, .turned = {{1, 1}}});
  });
  expectRefused(ErrorKind::usage, "a posed triangle alone", [&] { renderer.update(other, {.turned = {{0, 2}}}); });

  renderer.begin(mirrored.camera, mirrored.settings, 96, 54);
  EXPECT_EQ(refused([&] { renderer.pose(rest); }), ErrorKind::usage) << "a frame is under way";
  EXPECT_EQ(refused([&] { renderer.setModel(model); }), ErrorKind::usage);
}

TEST_F(PosedRenderer, AModelWhoseRigPointsNowhereIsRefusedAndTheOldOneStays) {
  const Mirrored mirrored;
  Renderer renderer = makeRenderer(mirrored.model.scene);
  renderer.setModel(mirrored.model);
  const auto picture = [&] { return drawWholeWith(renderer, mirrored.camera, mirrored.settings, 96, 54).layers.data; };
  const std::vector<float> before = picture();
  EXPECT_EQ(refused([&] { renderer.setModel(mirrored.model, AnimatedBounds{}); }), ErrorKind::usage);
  const struct {
    const char* says;
    std::function<void(Rig&)> edit;
  } cases[] = {
      {"node 1", [](Rig& rig) { rig.nodes[1].parent = 1; }},
      {"node 0", [](Rig& rig) { rig.nodes[0].parent = 70; }},
      {"skin 0", [](Rig& rig) { rig.skins[0].joints[1] = 4; }},
      {"skin 0", [](Rig& rig) { rig.skins[0].joints[1] = -1; }},
      {"skin 0", [](Rig& rig) { rig.skins[0].inverseBind.pop_back(); }},
      {"light 0", [](Rig& rig) { rig.lightNodes = {99}; }},
      {"camera 0", [](Rig& rig) { rig.cameraNodes = {4}; }},
      {"animation 0", [](Rig& rig) { rig.animations[0].channels[0].node = 4; }},
      {"animation 0", [](Rig& rig) { rig.animations[0].channels[0].node = -1; }},
      {"instance 1", [](Rig& rig) { rig.instances[1].node = 4; }},
      {"instance 1", [](Rig& rig) { rig.instances[1].firstVertex = 4000000000u; }},
      {"instance 1", [](Rig& rig) { rig.instances[1].vertexCount = 2; }},
      {"instance 1", [](Rig& rig) { rig.instances[1].firstTriangle = 0; }},
      {"instance 1", [](Rig& rig) { rig.instances[1].triangleCount = 4000000000u; }},
      {"instance 2", [](Rig& rig) { rig.instances[2].skin = 1; }},
      {"instance 2", [](Rig& rig) { rig.skins.emplace_back(), rig.instances[2].skin = 1; }},
      {"instance 2", [](Rig& rig) { rig.instances[2].joints.pop_back(); }},
      {"instance 2", [](Rig& rig) { rig.instances[2].weights.clear(); }},
      {"instance 2", [](Rig& rig) { rig.instances[2].joints[1][3] = 2; }},
      {"instance 0",
       [](Rig& rig) {
         rig.instances[0].targets = {{{glm::vec3(0)}, {}, {}}};
       }},
      {"instance 0",
       [](Rig& rig) {
         rig.instances[0].rest.pop_back(), rig.instances[0].vertexCount = 2, rig.instances[0].flatNormals = true;
       }},
  };
  for (const auto& each : cases) {
    Model broken = mirrored.model;
    broken.rig.animations = {{"move", 1, {{1, AnimatedProperty::scale, Interpolation::step, {0}, {1, 1, 1}}}}};
    EXPECT_NO_THROW(animatedBounds(broken));
    each.edit(broken.rig);
    std::string message;
    EXPECT_EQ(refused([&] { renderer.setModel(broken); }, &message), ErrorKind::usage) << each.says;
    EXPECT_NE(message.find(each.says), std::string::npos) << message;
    EXPECT_EQ(refused([&] { animatedBounds(broken); }), ErrorKind::usage) << each.says;
    EXPECT_EQ(picture(), before) << each.says;
  }
}

// A GL function that fails when it is told to, as an allocation may.
bool readsFail = false;
PFNGLGETNAMEDBUFFERSUBDATAPROC readBuffer = nullptr;
void APIENTRY readOrFail(GLuint buffer, GLintptr offset, GLsizeiptr size, void* data) {
  if (readsFail) throw std::bad_alloc();
  readBuffer(buffer, offset, size, data);
}

TEST_F(PosedRenderer, APoseThatFailsMidwayIsMadeUpForByTheNext) {
  Mirrored mirrored;
  set(mirrored.settings, "trace.method", "bvh");
  readBuffer = api.GetNamedBufferSubData;
  Renderer renderer([this](const char* name) {
    return std::string(name) == "glGetNamedBufferSubData" ? reinterpret_cast<Renderer::Proc>(&readOrFail)
                                                          : context.getProcAddress()(name);
  });
  renderer.setModel(mirrored.model);
  renderer.pose(evaluate(mirrored.model.rig, {}));
  drawWholeWith(renderer, mirrored.camera, mirrored.settings, 96, 54);
  readsFail = true;  // the first instance moves, then the second is turned
  EXPECT_THROW(renderer.pose(mirrored.state), std::bad_alloc);
  readsFail = false;
  drawWholeWith(renderer, mirrored.camera, mirrored.settings, 96, 54);
  mirrored.state.world[1] = glm::dmat4(1);
  renderer.pose(mirrored.state);
  const Frame frame = drawWholeWith(renderer, mirrored.camera, mirrored.settings, 96, 54);
  pose(mirrored.model, mirrored.state);
  const Frame truth = draw(mirrored.model.scene, mirrored.camera, mirrored.settings, 96, 54);
  EXPECT_EQ(frame.plane("depth.Z"), truth.plane("depth.Z"));
  const std::vector<float> hits = frame.plane("hit.id");
  EXPECT_EQ(hits, truth.plane("hit.id"));
  EXPECT_GT(std::count(hits.begin(), hits.end(), 0.0f), 5) << "the lifted one, in the floor";
}

TEST_F(PosedRenderer, AFrameThatCannotPoseLeavesThatToTheNext) {
  Mirrored mirrored;
  Renderer renderer = makeRenderer(mirrored.model.scene);
  renderer.setModel(mirrored.model);
  renderer.pose(mirrored.state);
  withShaders({{"passes/pose.comp", "void main() {", "void main() { nonsense;"}}, [&] {
    EXPECT_EQ(refused([&] { drawWith(renderer, mirrored.camera, mirrored.settings, 96, 54); }), ErrorKind::failed);
  });
  takeErrors();  // of the compiler
  const Frame frame = drawWholeWith(renderer, mirrored.camera, mirrored.settings, 96, 54);
  const Frame truth = draw(mirrored.truth, mirrored.camera, mirrored.settings, 96, 54);
  EXPECT_EQ(frame.plane("depth.Z"), truth.plane("depth.Z"));
  EXPECT_EQ(frame.plane("hit.id"), truth.plane("hit.id"));
}

TEST_F(PosedRenderer, BindsAllThatItReads) {
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
