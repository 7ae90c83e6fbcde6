// Camera rays through the object intersection buffer of Robert et al. 2007 (PrimarySettings).
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <halfsilver/builtin.h>
#include "gpu/light_fixture.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

using glm::dvec3;
using glm::vec3;
using Choices = std::initializer_list<std::pair<const char*, const char*>>;

constexpr int kWidth = 96, kHeight = 72;

class PrimaryHitTest : public TracingTest {
 protected:
  Frame see(const Scene& scene, const Camera& camera, Choices choices) {
    Settings wanted = settingsWith({{"trace.method", "exact"}});
    for (const auto& [name, value] : choices) set(wanted, name, value);
    return draw(scene, camera, wanted, kWidth, kHeight);
  }
};

// The ray of a pixel, whose row 0 is the bottom.
dvec3 rayOf(const Camera& camera, int x, int y) {
  const dvec3 forward = glm::normalize(dvec3(camera.target) - dvec3(camera.eye));
  const dvec3 right = glm::normalize(glm::cross(forward, dvec3(0, 1, 0))), up = glm::cross(right, forward);
  const double tangent = std::tan(0.5 * static_cast<double>(camera.verticalFov));
  return forward + (2 * x + 1 - kWidth) / double{kHeight} * tangent * right +
         (2 * y + 1 - kHeight) / double{kHeight} * tangent * up;
}

// How far outside the triangle the ray passes, as a barycentric; 0 inside.
double outside(const Scene& scene, std::uint32_t triangle, const dvec3& origin, const dvec3& ray) {
  const auto corner = [&](int i) {
    return dvec3(scene.vertices[scene.triangles[triangle].vertices[static_cast<std::size_t>(i)]].position) - origin;
  };
  const dvec3 a = corner(0), edge1 = corner(1) - a, edge2 = corner(2) - a, p = glm::cross(ray, edge2);
  const double determinant = glm::dot(edge1, p);
  const double u = glm::dot(-a, p) / determinant, v = glm::dot(ray, glm::cross(-a, edge1)) / determinant;
  return std::max({0.0, -u, -v, u + v - 1});
}

TEST_F(PrimaryHitTest, ATestedPixelShowsATriangleThatItsRayMeets) {
  const Scene scene = makeBuiltin("teapot").scene;
  Camera camera = scene.cameras.front();
  for (const char* multisampling : {"none", "lazy", "full"}) {
    SCOPED_TRACE(multisampling);
    Renderer renderer = makeRenderer(scene);
    Settings wanted = settingsWith({{"trace.method", "exact"}, {"primary.hits", "tested"}});
    set(wanted, "primary.multisampling", multisampling);
    const Frame frame = drawWith(renderer, camera, wanted, kWidth, kHeight);
    int shown = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const auto picked = renderer.pick(x, y);
        if (!picked) continue;
        ++shown;
        ASSERT_LT(outside(scene, picked->triangle, dvec3(camera.eye), rayOf(camera, x, y)), 1e-4) << x << " " << y;
      }
    EXPECT_GT(shown, 3000);
    const std::vector<float> depth = frame.plane("depth.Z");
    EXPECT_EQ(shown, std::count_if(depth.begin(), depth.end(), [](float d) { return d > 0; }));
  }
}

// Triangles smaller than pixels: rasterization, which snaps corners, gives some pixels to a neighbor.
TEST_F(PrimaryHitTest, NeighborsKnowWhatAPixelsOwnTriangleMisses) {
  const Scene scene = makeBuiltin("teapot").scene;
  const Camera camera = scene.cameras.front();
  const auto with = [&](const char* multisampling, const char* neighborhood) {
    return see(scene, camera,
               {{"primary.hits", "tested"},
                {"primary.multisampling", multisampling},
                {"primary.neighborhood", neighborhood}})
        .report;
  };
  const FrameReport raster = see(scene, camera, {}).report, none = with("none", "3");
  EXPECT_EQ(raster.resampled + raster.interpolated, 0u);
  EXPECT_EQ(none.resampled, 0u);
  EXPECT_GT(none.interpolated, 0u);
  EXPECT_LT(none.interpolated, none.pixels / 50);
  std::uint64_t before = none.interpolated;
  for (const char* neighborhood : {"3", "5"}) {
    const FrameReport lazy = with("lazy", neighborhood), full = with("full", neighborhood);
    EXPECT_LE(lazy.interpolated, before);
    EXPECT_EQ(lazy.resampled + lazy.interpolated, none.interpolated) << "only where the own triangle is missed";
    EXPECT_EQ(full.interpolated, lazy.interpolated);
    EXPECT_GE(full.resampled, lazy.resampled);
    before = lazy.interpolated;
  }
  RecordProperty("none", std::to_string(none.interpolated));
  RecordProperty("lazy_5", std::to_string(before));
}

TEST_F(PrimaryHitTest, APixelThatKeepsItsTriangleHasTheReferencesMirrorRay) {
  for (const char* name : {"sphere", "teapot", "atrium"}) {
    SCOPED_TRACE(name);
    const Scene scene = makeBuiltin(name).scene;
    const Camera camera = scene.cameras.front();
    const Frame reference = see(scene, camera, {}), found = see(scene, camera, {{"primary.hits", "tested"}});
    const HitErrors errors = compareHits(found, reference, glm::length(scene.bounds().extent()));
    EXPECT_GT(errors.rays, 500u);
    const std::uint64_t others = found.report.resampled + found.report.interpolated;
    EXPECT_LT(others, errors.rays / 20);
    EXPECT_LE(errors.hitError * static_cast<double>(errors.rays), static_cast<double>(others) + 0.5);
  }
}

TEST_F(PrimaryHitTest, PixelsThatInterleavingLeavesOutLieBetweenTheirNeighbors) {
  Scene scene = soup(120);
  scene.lights = {sun({-0.3f, -1, -0.4f}, 2)};
  const Frame all = see(scene, kAbove, {}), found = see(scene, kAbove, {{"primary.every", "2"}});
  EXPECT_EQ(found.report.interpolated, found.report.pixels / 2);
  EXPECT_LT(found.report.selected, 0.6 * static_cast<double>(all.report.selected));
  EXPECT_GT(found.report.selected, 500u);
  const std::vector<float> before = all.plane("G"), after = found.plane("G");
  double sum = 0;
  for (int row = 2; row + 2 < kHeight; ++row)
    for (int x = 2; x + 2 < kWidth; ++x) {
      const int y = kHeight - 1 - row;  // from the bottom
      const auto at = [&](int dx, int dy) { return after[static_cast<std::size_t>((row + dy) * kWidth + x + dx)]; };
      if ((x + y) % 2 == 0) {
        ASSERT_EQ(at(0, 0), before[static_cast<std::size_t>(row * kWidth + x)]) << x << " " << row;
        continue;
      }
      float low = at(1, 0), high = low;
      for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx) {
          if ((dx + dy) % 2 == 0) continue;
          low = std::min(low, at(dx, dy));
          high = std::max(high, at(dx, dy));
        }
      ASSERT_GE(at(0, 0), low * 0.9999f);
      ASSERT_LE(at(0, 0), high * 1.0001f);
      sum += std::abs(static_cast<double>(at(0, 0)) -
                      static_cast<double>(before[static_cast<std::size_t>(row * kWidth + x)]));
    }
  EXPECT_GT(sum, 1) << "it blurs";
}

TEST_F(PrimaryHitTest, OneInManyRaysIsEnoughForAPicture) {
  Scene scene = soup(40);
  scene.lights = {sun({-0.3f, -1, -0.4f}, 2)};
  for (const char* every : {"3", "4", "8"}) {
    SCOPED_TRACE(every);
    const Frame found = see(scene, kAbove, {{"primary.every", every}});
    const auto pixels = static_cast<double>(found.report.pixels);
    EXPECT_NEAR(static_cast<double>(found.report.interpolated), pixels * (1 - 1 / std::atof(every)), 0.01 * pixels);
    const std::vector<float> light = found.plane("G");
    EXPECT_LT(std::count(light.begin(), light.end(), 0.0f), 0.02 * pixels) << "no pixel is without a neighbor";
  }
}

// Figure 2 of the paper: triangles at the same depth. Tests of the whole neighborhood choose the lowest number, so the
// picture depends on no order.
TEST_F(PrimaryHitTest, OfTrianglesAtOneDepthTheFirstIsShown) {
  Scene scene;
  scene.sky = blackSky();
  addQuad(scene, vec3(0), {1, 0, 0}, {0, 1, 0}, addMaterial(scene, diffuse({0.8f, 0, 0})));
  addQuad(scene, vec3(0), {1, 0, 0}, {0, 1, 0}, addMaterial(scene, diffuse({0, 0.8f, 0})));
  scene.lights = {sun({0, 0, -1}, 2)};
  const Camera camera = lookAt({0, 0, 1.2f}, vec3(0));
  const Frame found = see(scene, camera, {{"primary.hits", "tested"}, {"primary.multisampling", "full"}});
  const std::vector<float> red = found.plane("R"), green = found.plane("G"), depth = found.plane("depth.Z");
  int shown = 0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (depth[i] <= 0) continue;
    ++shown;
    ASSERT_GT(red[i], 0.1f);
    ASSERT_LT(green[i], 1e-5f);
  }
  EXPECT_GT(shown, 2000);
}

// Where 24 bits of depth cannot tell two sheets apart (2 mm behind each other, 400 m away), floats can.
TEST_F(PrimaryHitTest, SheetsCloserThanTheDepthOfThePaperAreTold) {
  Scene scene;
  scene.sky = blackSky();
  addQuad(scene, {0, 0, -400}, {200, 0, 0}, {0, 150, 0}, addMaterial(scene, diffuse({0.8f, 0, 0})));
  addQuad(scene, {0, 0, -400.002f}, {200, 0, 0}, {0, 150, 0}, addMaterial(scene, diffuse({0, 0.8f, 0})));
  scene.lights = {sun({0, 0, -1}, 2)};
  const Frame found = see(scene, lookAt(vec3(0), {0, 0, -1}), {{"primary.hits", "tested"}});
  const std::vector<float> red = found.plane("R"), green = found.plane("G");
  EXPECT_GT(std::count_if(red.begin(), red.end(), [](float r) { return r > 0.1f; }), 2000);
  EXPECT_EQ(std::count_if(green.begin(), green.end(), [](float g) { return g > 1e-5f; }), 0);
}

}  // namespace
}  // namespace halfsilver::testing
