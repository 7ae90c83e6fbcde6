// The attribute methods' own settings: what is inside, how many voxels, and rays that need no exact hit.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <halfsilver/builtin.h>
#include <halfsilver/io.h>
#include "builtin/mesh_builder.h"
#include "gpu/shader_function.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

class AttributesTest : public TracingTest {
 protected:
  static Settings hu(std::initializer_list<std::pair<const char*, const char*>> more = {}) {
    Settings settings = settingsWith({});
    applyPreset(settings, "hu2014");
    for (const auto& [name, value] :
         {std::pair("select.mode", "reflective"), {"voxels.resolution", "32"}, {"abuffer.resolution", "512"}})
      set(settings, name, value);
    for (const auto& [name, value] : more) set(settings, name, value);
    return settings;
  }
};

void addBall(Scene& scene, const glm::vec3& center, double radius, std::uint32_t material) {
  MeshBuilder build;
  build.lathe(Profile().arc({0, 0}, radius, 0.5 * kPi, -0.5 * kPi, 40), center, 80);
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  scene.vertices.insert(scene.vertices.end(), build.mesh().vertices.begin(), build.mesh().vertices.end());
  for (Triangle triangle : build.mesh().triangles) {
    for (std::uint32_t& vertex : triangle.vertices) vertex += first;
    triangle.material = material;
    scene.triangles.push_back(triangle);
  }
}

Scene ballsOverAMirror() {
  Scene scene;
  scene.materials = {mirrorMaterial(), plain({0.8f, 0.3f, 0.2f})};
  addQuad(scene, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, 0);
  addBall(scene, {-0.7f, 0.6f, 0}, 0.5, 1);
  addBall(scene, {0.6f, 0.9f, -0.4f}, 0.6, 1);
  return scene;
}

TEST_F(AttributesTest, DepthsAloneFindClosedObjects) {
  const Scene scene = ballsOverAMirror();
  const Frame exact = draw(scene, kAbove, settingsWith({{"trace.method", "exact"}}), 120, 90);
  const Frame frame = draw(scene, kAbove, hu(), 120, 90);
  const HitErrors errors = compareHits(frame, exact, scene.bounds().diagonal());
  expectNontrivial(errors, exact);
  EXPECT_LE(errors.hitError, 0.01);
  EXPECT_NE(frame.plane("hit.T"), draw(scene, kAbove, hu({{"search.test", "plane"}}), 120, 90).plane("hit.T"));
}

// A ray inside an object looks for the first point outside: the way out of glass.
TEST_F(AttributesTest, DepthsAloneFindTheWayOutOfAnObject) {
  Scene scene;
  scene.materials = {mirrorMaterial()};
  scene.materials[0].doubleSided = true;
  addBall(scene, {0, 0, 0}, 1, 0);
  const Camera inside = lookAt({0.3f, 0.2f, 0.4f}, {-1, 0.1f, -0.5f});
  const Frame exact = draw(scene, inside, settingsWith({{"trace.method", "exact"}}), 120, 90);
  const Frame frame = draw(scene, inside, hu(), 120, 90);
  const HitErrors errors = compareHits(frame, exact, scene.bounds().diagonal());
  EXPECT_EQ(errors.rays, 120u * 90u);
  expectNontrivial(errors, exact);
  EXPECT_LE(errors.hitError, 0.032);
}

// A ray on its way into glass faces the surface that it leaves, other than one that is reflected: it must not hit that.
TEST_F(AttributesTest, RaysIntoGlassDoNotHitWhatTheyPass) {
  const Model model = makeBuiltin("glass");
  // The ball of green glass, which fills the picture.
  Camera camera = lookAt({1.7f, 0.6f, 2.4f}, {1.7f, 0.45f, 0.9f});
  camera.verticalFov = 0.5f;
  const auto light = [&](const Settings& settings) {
    return draw(model.scene, camera, settings, 64, 48).plane("reflection.G");
  };
  const std::vector<float> exact = light(settingsWith(
      {{"trace.method", "exact"}, {"select.mode", "all"}, {"trace.effect", "whitted"}, {"trace.bounces", "3"}}));
  const std::vector<float> found =
      light(hu({{"select.mode", "all"}, {"trace.effect", "whitted"}, {"trace.bounces", "3"}}));
  std::size_t far = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) far += std::abs(found[i] - exact[i]) > 0.1f * exact[i] ? 1 : 0;
  EXPECT_GT(*std::max_element(exact.begin(), exact.end()), 0.2f);
  EXPECT_LT(far, exact.size() / 10) << "of " << exact.size();
  RecordProperty("far", static_cast<int>(far));
}

// Two sheets between two points of the search leave both on the same side of everything.
TEST_F(AttributesTest, SheetsCancelForDepthsAlone) {
  Scene scene;
  scene.materials = {mirrorMaterial(), plain({1, 1, 1})};
  scene.materials[1].doubleSided = true;
  addQuad(scene, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, 0);
  for (const float y : {1.10f, 1.105f}) addQuad(scene, {-2, y, 2}, {2, y, 2}, {2, y, -2}, {-2, y, -2}, 1);
  addTriangle(scene, {0, 4, 0}, {0.01f, 4, 0}, {0, 4, 0.01f}, 1);
  const Camera camera = lookAt({0, 0.8f, 0.5f}, {0, 0, 0});
  const auto hits = [&](const char* test) {
    const Frame frame = draw(scene, camera, hu({{"voxels.resolution", "16"}, {"search.test", test}}), 40, 30);
    std::size_t count = 0;
    for (const float t : frame.plane("hit.T")) count += t >= 0 ? 1 : 0;
    return count;
  };
  const std::size_t seen = hits("plane");
  EXPECT_GT(seen, 800u);
  EXPECT_LT(hits("depth"), seen / 4);
}

TEST_F(AttributesTest, AutoHasAsManyVoxelsAsTheTexelsNeed) {
  const Scene scene = soup(100);
  const Frame frame = draw(scene, kAbove, hu({{"voxels.resolution", "auto"}, {"abuffer.resolution", "300"}}), 40, 30);
  for (const int voxels : frame.report.memory.grid) EXPECT_EQ(voxels, 30);
  EXPECT_GT(frame.report.selected, 100u);
}

// Mirror rays keep their exact hits, rays that any hit stops are through sooner and nearly always find the same.
TEST_F(AttributesTest, RaysThatAnyHitStopsAreNotRefined) {
  const Scene scene = ballsOverAMirror();
  for (const char* refinements : {"0", "6"}) {
    const Frame mirrors = draw(scene, kAbove, hu({{"search.any_hit_refinements", refinements}}), 80, 60);
    EXPECT_EQ(mirrors.plane("hit.T"), draw(scene, kAbove, hu(), 80, 60).plane("hit.T")) << refinements;
  }
  const auto shares = [&](const char* refinements) {
    return draw(scene, kAbove,
                hu({{"trace.effect", "occlusion"},
                    {"effect.samples", "16"},
                    {"search.any_hit_refinements", refinements}}),
                80, 60)
        .plane("reflection.R");
  };
  const std::vector<float> coarse = shares("0"), fine = shares("6");
  double apart = 0, hidden = 0;
  for (std::size_t i = 0; i < fine.size(); ++i) {
    apart += std::abs(static_cast<double>(coarse[i] - fine[i]));
    hidden += 1 - static_cast<double>(fine[i]);
  }
  EXPECT_GT(hidden, 100);
  EXPECT_GT(apart, 0) << "the setting does nothing";
  EXPECT_LT(apart, 0.05 * hidden);
}

}  // namespace
}  // namespace halfsilver::testing
