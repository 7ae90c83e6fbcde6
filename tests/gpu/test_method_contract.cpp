// What every method owes, through the public renderer.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <halfsilver/io.h>
#include "gpu/method_contract.h"
#include "gpu/shader_function.h"
#include "gpu/small_blocks.h"

namespace halfsilver::testing {

MethodTest::MethodTest() {
  if (!GetParam().shaders) return;
  namespace fs = std::filesystem;
  const fs::path project(HALFSILVER_SOURCE_DIR);
  shaders_.emplace();
  for (const fs::path& folder : {project / "shaders", project / "tests" / GetParam().shaders})
    fs::copy(folder, shaders_->path(), fs::copy_options::recursive);
  ::setenv("HALFSILVER_SHADERS", shaders_->path().c_str(), 1);
}

MethodTest::~MethodTest() {
  if (shaders_) ::unsetenv("HALFSILVER_SHADERS");
}

Settings MethodTest::settings(std::initializer_list<std::pair<const char*, const char*>> more) {
  Settings result = settingsWith({});
  applyPreset(result, GetParam().preset);
  if (GetParam().brought) result.trace.method = GetParam().brought().info.name;
  for (const auto& [name, value] : GetParam().settings) set(result, name, value);
  for (const auto& [name, value] : more) set(result, name, value);
  return result;
}

std::vector<Method> MethodTest::methods(const Scene& scene) const {
  std::vector<Method> all = TracingTest::methods(scene);
  if (GetParam().brought) all.push_back(GetParam().brought());
  return all;
}

namespace {

const MethodCase kMethods[] = {
    {"identity", "halfsilver", {}, 0},
    {"exact", "reference", {}, 0},
    {"bvh", "bvh", {}, 0},
    {"screen_space", "screen-space", {}, 0.107},
    {"screen_first", "screen-first", {}, 0.0031},
    {"planar", "planar", {}, 0},
    {"cubemap", "cubemap", {}, 0.409},
    {"kastrati2017", "kastrati2017", {{"abuffer.resolution", "256"}}, 0.086},
    {"kastrati_plain", "kastrati2017", {{"voxels.raster", "voxel"}, {"abuffer.resolution", "256"}}, 0.106},
    {"kastrati_full",
     "kastrati2017",
     {{"voxels.raster", "abuffer"}, {"search.steps", "0"}, {"abuffer.resolution", "256"}},
     0.063},
    {"burger2007", "burger2007", {{"abuffer.resolution", "256"}}, 0.045},
    {"burger_all_axes",
     "burger2007",
     {{"cube.axes", "all"}, {"cube.depth", "single"}, {"cube.block", "5"}, {"abuffer.resolution", "256"}},
     0.055},
    // Depths alone ask for watertight objects; the soup is of open sheets, which cancel in pairs.
    {"hu2014", "hu2014", {{"select.mode", "reflective"}, {"abuffer.resolution", "256"}}, 0.3},
    {"hu_planes",
     "hu2014",
     {{"select.mode", "reflective"}, {"search.test", "plane"}, {"abuffer.resolution", "256"}},
     0.048},
    // Hits lie up to a voxel early, which is more than the tolerance; its errors are bounded by test_voxels.cpp.
    {"voxels", "voxels", {{"voxels.resolution", "48"}}, 0.68},
    {"hu_full", "hu2014", {{"select.mode", "reflective"}, {"search.steps", "0"}, {"abuffer.resolution", "256"}}, 0.3},
};

// What every method owes: an answer to each selected ray, none to the others, near the truth, the same every time.
TEST_P(MethodTest, KeepsTheContract) {
  const Scene scene = soup(600);
  const Frame exact = draw(scene, kAbove, settingsWith({{"trace.method", "exact"}}), 80, 60);
  const Frame frame = draw(scene, kAbove, settings(), 80, 60);
  const HitErrors errors = compareHits(frame, exact, scene.bounds().diagonal());
  expectNontrivial(errors, exact);
  EXPECT_LE(errors.hitError, GetParam().maxHitError);
  RecordProperty("hit_error", std::to_string(errors.hitError));
  const std::vector<float> t = frame.plane("hit.T"), id = frame.plane("hit.id"), selected = frame.plane("selected.Y");
  std::size_t rays = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    EXPECT_TRUE(std::isfinite(t[i]));
    EXPECT_EQ(selected[i] == 0, t[i] == -2.0f);
    EXPECT_EQ(t[i] >= 0, id[i] >= 0);
    if (t[i] >= 0) {
      EXPECT_LT(id[i], static_cast<float>(scene.triangles.size()));
    }
    rays += selected[i] != 0 ? 1u : 0u;
  }
  EXPECT_EQ(rays, frame.report.selected);
  EXPECT_EQ(frame.report.overflow, 0u);
  for (const float value : frame.layers.data) ASSERT_TRUE(std::isfinite(value));

  const Frame again = draw(scene, kAbove, settings(), 80, 60);
  EXPECT_EQ(frame.layers.data, again.layers.data);
}

TEST_P(MethodTest, NoSelectedPixelNoRay) {
  const Scene scene = soup(50);
  const Frame frame = draw(scene, kAbove, settings({{"select.fraction", "0"}}), 40, 30);
  EXPECT_EQ(frame.report.selected, 0u);
  for (const float t : frame.plane("hit.T")) ASSERT_EQ(t, -2.0f);
}

TEST_P(MethodTest, BatchesForSmallStorageBlocksChangeNothing) {
  constexpr int kWidth = 256, kHeight = 192;
  static_assert(kWidth * kHeight * sizeof(shared::Ray) > kSmallBlock, "one batch would do");
  const Scene scene = soup(100);
  const Settings wanted =
      settings({{"trace.bounces", "2"}, {"shadow.resolution", "64"}, {"shadow.sky_directions", "0"}});
  const Frame whole = draw(scene, kAbove, wanted, kWidth, kHeight);
  Renderer renderer(withSmallBlocks(context.getProcAddress()), methods(scene));
  renderer.setScene(scene);
  const Frame batches = drawWholeWith(renderer, kAbove, wanted, kWidth, kHeight);
  EXPECT_GT(whole.report.selected, 10000u);
  EXPECT_EQ(whole.layers.data, batches.layers.data);
  EXPECT_EQ(whole.report.selected, batches.report.selected);
  EXPECT_EQ(whole.report.reflecting, batches.report.reflecting);
  EXPECT_EQ(whole.report.contributions, batches.report.contributions);
  EXPECT_EQ(whole.report.overflow, batches.report.overflow);
}

TEST_P(MethodTest, FragmentsEqualCompute) {
  if (GetParam().name == std::string("exact")) GTEST_SKIP() << "the exact tracer has no shader stage";
  const Scene scene = soup(300);
  const Frame compute = draw(scene, kAbove, settings({{"trace.stage", "compute"}}), 64, 48);
  const Frame fragment = draw(scene, kAbove, settings({{"trace.stage", "fragment"}}), 64, 48);
  EXPECT_GT(compute.report.selected, 300u);
  EXPECT_EQ(compute.layers.data, fragment.layers.data);
}

TEST_P(MethodTest, BouncesBetweenMirrors) {
  if (GetParam().name == std::string("screen_space")) GTEST_SKIP() << "the camera sees one of the mirrors";
  if (GetParam().name == std::string("planar")) GTEST_SKIP() << "it knows one of the mirrors";
  Scene scene;
  scene.materials = {mirrorMaterial(), mirrorMaterial(), plain({1, 0, 0})};
  scene.materials[2].emissive = {1, 0, 0};
  // Two mirrors face each other under a glowing ceiling, which more paths reach with more bounces.
  addQuad(scene, {-9, 2.5f, -9}, {9, 2.5f, -9}, {9, 2.5f, 9}, {-9, 2.5f, 9}, 2);
  addQuad(scene, {-2, -2, -2}, {2, -2, -2}, {2, 2, -2}, {-2, 2, -2}, 0);
  addQuad(scene, {2, -2, 2}, {-2, -2, 2}, {-2, 2, 2}, {2, 2, 2}, 1);
  const Camera camera = lookAt({0, 0, 0}, {0, 0, -1});
  const Frame one = draw(scene, camera, settings({{"trace.bounces", "1"}}), 32, 24);
  const Frame three = draw(scene, camera, settings({{"trace.bounces", "3"}}), 32, 24);
  EXPECT_GT(one.report.selected, 100u);
  EXPECT_EQ(one.plane("hit.T"), three.plane("hit.T"));
  EXPECT_NE(one.plane("reflection.B"), three.plane("reflection.B"));
}

INSTANTIATE_TEST_SUITE_P(AllMethods, MethodTest, ::testing::ValuesIn(kMethods),
                         [](const auto& method) { return std::string(method.param.name); });

}  // namespace
}  // namespace halfsilver::testing
