#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/demo/false_colors.h"
#include "apps/demo/options.h"
#include "apps/demo/viewer.h"
#include "apps/demo/viewer_camera.h"
#include "gltf_files.h"

#if HALFSILVER_DEMO

namespace halfsilver::demo {
namespace {

const Bounds kRoom = [] {
  Bounds bounds;
  bounds.add({-5, 0, -5});
  bounds.add({5, 4, 5});
  return bounds;
}();

Camera start() {
  Camera camera;
  camera.eye = {0, 2, 8};
  camera.target = {0, 2, 0};
  return camera;
}

TEST(ViewerCamera, BeginsWhereItWasPut) {
  const Camera camera = ViewerCamera(start(), kRoom).camera();
  EXPECT_LT(glm::distance(camera.eye, start().eye), 1e-5f);
  EXPECT_LT(glm::distance(camera.target, start().target), 1e-5f);
}

TEST(ViewerCamera, OrbitsAroundThePivotAndNeverOverIt) {
  ViewerCamera viewer(start(), kRoom);
  Controls controls;
  controls.orbit = {300, 10000};
  viewer.follow(controls, 0, 600);
  const Camera camera = viewer.camera();
  EXPECT_LT(glm::distance(camera.target, start().target), 1e-5f);
  EXPECT_NEAR(glm::distance(camera.eye, camera.target), 8, 1e-4f);
  EXPECT_GT(camera.eye.y, 9.9f);
  EXPECT_GT(glm::length(glm::vec2(camera.eye.x, camera.eye.z)), 0.05f);
}

TEST(ViewerCamera, PanningMovesThePivotWithThePointer) {
  ViewerCamera viewer(start(), kRoom);
  Controls controls;
  controls.pan = {0, 600};
  viewer.follow(controls, 0, 600);
  const float height = 2 * 8 * std::tan(0.5f * start().verticalFov);
  EXPECT_NEAR(viewer.camera().target.y, 2 + height, 1e-3f) << "a window's height is what it shows at the pivot";
}

TEST(ViewerCamera, LooksAroundAndFliesWhereItLooks) {
  ViewerCamera viewer(start(), kRoom);
  Controls controls;
  controls.look = {120, 0};
  viewer.follow(controls, 0, 600);
  EXPECT_LT(glm::distance(viewer.camera().eye, start().eye), 1e-4f) << "looking around moves nothing";
  const glm::vec3 forward = glm::normalize(viewer.camera().target - viewer.camera().eye);
  Controls flight;
  flight.flying = true;
  flight.move = {0, 0, 1};
  viewer.follow(flight, 0.5, 600);
  const glm::vec3 moved = viewer.camera().eye - start().eye;
  EXPECT_NEAR(glm::dot(glm::normalize(moved), forward), 1, 1e-4f);
  EXPECT_NEAR(glm::length(moved), 0.5f * viewer.speed(), 1e-3f);
}

TEST(ViewerCamera, FramesWhatIsAskedFor) {
  ViewerCamera viewer(start(), kRoom);
  Bounds small;
  small.add({1, 1, 1});
  small.add({1.2f, 1.2f, 1.2f});
  viewer.frame(small);
  EXPECT_LT(glm::distance(viewer.camera().target, small.center()), 1e-5f);
  EXPECT_LT(glm::distance(viewer.camera().eye, small.center()), 1);
}

TEST(PosedBounds, AreThoseOfAMaterialInThePoseAndLeaveTheModelAsItIs) {
  Model model;
  model.scene.materials.resize(2);
  model.rig.nodes.resize(2);
  for (const int node : {0, 1}) {
    Instance instance;
    instance.node = node;
    instance.firstVertex = static_cast<std::uint32_t>(3 * node);
    instance.firstTriangle = static_cast<std::uint32_t>(node);
    instance.vertexCount = 3;
    instance.triangleCount = 1;
    instance.rest.resize(3);
    instance.rest[1].position = {1, 0, 0};
    instance.rest[2].position = {0, 1, 0};
    model.scene.vertices.insert(model.scene.vertices.end(), instance.rest.begin(), instance.rest.end());
    model.scene.triangles.push_back(
        {{instance.firstVertex, instance.firstVertex + 1, instance.firstVertex + 2}, static_cast<std::uint32_t>(node)});
    model.rig.instances.push_back(instance);
  }
  model.scene.lights.emplace_back().position = {7, 7, 7};
  model.rig.lightNodes = {1};
  Rig mirrored = model.rig;
  mirrored.nodes[1].scale.x = -2;
  mirrored.nodes[1].translation.y = 3;
  const PoseState state = evaluate(mirrored, {});
  const Bounds one = posedBounds(model, state, 1), all = posedBounds(model, state, {});
  EXPECT_EQ(one.low, glm::vec3(-2, 3, 0));
  EXPECT_EQ(one.high, glm::vec3(0, 4, 0));
  EXPECT_EQ(all.low, glm::vec3(-2, 0, 0));
  EXPECT_EQ(all.high, glm::vec3(1, 4, 0));
  EXPECT_EQ(model.scene.vertices[4].position, glm::vec3(1, 0, 0));
  EXPECT_EQ(model.scene.triangles[1].vertices, (std::array<std::uint32_t, 3>{3, 4, 5}));
  EXPECT_FALSE(model.rig.instances[1].turned);
  EXPECT_EQ(model.scene.lights[0].position, glm::vec3(7));
}

TEST(DemoOptions, AreKeptBetweenRuns) {
  const testing::TemporaryFolder folder;
  Options options;
  options.settings.image.exposure = 1.5f;
  options.settings.trace.method = "bvh";
  options.overlay = false;
  options.bestSeconds = 61.5;
  ASSERT_TRUE(save(folder.path() / "new", options));
  Options loaded;
  load(folder.path() / "new", loaded);
  EXPECT_EQ(loaded.settings, options.settings);
  EXPECT_FALSE(loaded.overlay);
  EXPECT_EQ(loaded.bestSeconds, 61.5);
}

TEST(DemoOptions, BrokenFilesAndFoldersThatCannotBeWrittenAreNoErrors) {
  const testing::TemporaryFolder folder;
  folder.write("demo.json", "{\"overlay\": 3, \"best_seconds\"");
  folder.write("demo-settings.toml", "[nothing]\nsense = 1\n");
  Options loaded;
  load(folder.path(), loaded);
  EXPECT_EQ(loaded.settings, Settings());
  EXPECT_TRUE(loaded.overlay);
  folder.write("file", "");
  EXPECT_FALSE(save(folder.path() / "file" / "below", loaded));
  EXPECT_FALSE(save({}, loaded));
}

TEST(FalseColors, SayWhatAnsweredEachPixel) {
  Image layers{4, 1, {"R", "G", "B", "depth.Z", "reflectivity.Y", "selected.Y", "hit.T", "hit.id"}, {}};
  layers.data = {0.1f, 0.1f, 0.1f, 1, 1, 1, 2,  7,    // a hit
                 0.1f, 0.1f, 0.1f, 1, 1, 1, -1, -1,   // the sky
                 0.1f, 0.1f, 0.1f, 1, 1, 0, -2, -1,   // not traced
                 0.1f, 0.1f, 0.1f, 1, 1, 1, -3, -1};  // given up
  const std::vector<std::uint8_t> rgba = falseColors(View::answer, layers, nullptr, 10);
  const auto most = [&](std::size_t pixel) {
    const auto first = rgba.begin() + static_cast<std::ptrdiff_t>(4 * pixel);
    return std::max_element(first, first + 3) - first;
  };
  ASSERT_EQ(rgba.size(), 16u);
  EXPECT_EQ(most(0), 1);
  EXPECT_EQ(most(1), 2);
  EXPECT_EQ(most(3), 0);
  EXPECT_GT(rgba[8], 200) << "yellow";
  EXPECT_GT(rgba[9], 180);
  Image exact = layers;
  exact.data[6] = 2.5f;
  EXPECT_GT(falseColors(View::error, layers, &exact, 10)[0], 200) << "half a meter off is wrong";
  EXPECT_LT(falseColors(View::error, layers, &layers, 10)[0], 80);
}

}  // namespace
}  // namespace halfsilver::demo

#endif
