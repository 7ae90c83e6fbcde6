// Hits near the origins of rays: what touches a mirror shows in it, and no surface meets itself.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include <halfsilver/builtin.h>
#include <halfsilver/io.h>
#include "gpu/posed_models.h"
#include "gpu/render_fixture.h"
#include "shared_scenes.h"

namespace halfsilver::testing {
namespace {

using glm::dvec3;

constexpr int kWidth = 320, kHeight = 180;

struct Crossing {
  double t;
  bool inside;  // or beside it by less than the rasterizer's snapping
};

// Where a line crosses the plane of a triangle, in double precision.
Crossing crossing(const Scene& scene, std::size_t number, const dvec3& origin, const dvec3& direction) {
  const auto& corners = scene.triangles[number].vertices;
  const dvec3 a = scene.vertices[corners[0]].position;
  const dvec3 edge1 = dvec3(scene.vertices[corners[1]].position) - a;
  const dvec3 edge2 = dvec3(scene.vertices[corners[2]].position) - a;
  const dvec3 p = glm::cross(direction, edge2), from = origin - a;
  const double determinant = glm::dot(edge1, p);
  const dvec3 q = glm::cross(from, edge1);
  const double u = glm::dot(from, p) / determinant, v = glm::dot(direction, q) / determinant;
  return {glm::dot(edge2, q) / determinant, std::min({u, v, 1 - u - v}) > -0.01};
}

struct NearHits {
  std::size_t hits = 0, near = 0;  // near: ignored while 1e-5 of the diagonal was the least distance
  std::size_t own = 0;             // of these: of the surface that the ray leaves, which lies behind or at its origin
};

class NearHitsTest : public RenderTest {
 protected:
  // Every material a mirror, from the camera.
  NearHits count(Scene scene, const Camera& camera) {
    for (Material& material : scene.materials) material.mirror = 0.9f;
    Settings settings = settingsWith({{"shadow.resolution", "16"}, {"shadow.sky_directions", "0"}});
    const Frame frame = draw(scene, camera, settings, kWidth, kHeight);
    const double old = 1e-5 * static_cast<double>(scene.bounds().diagonal());
    const dvec3 eye = camera.eye, forward = glm::normalize(dvec3(camera.target) - eye);
    const dvec3 right = glm::normalize(glm::cross(forward, dvec3(camera.up))), up = glm::cross(right, forward);
    const double tangent = std::tan(0.5 * static_cast<double>(camera.verticalFov));
    NearHits result;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const double t = frame.at(x, y, "hit.T");
        result.hits += t >= 0;
        if (t < 0 || t >= old) continue;
        ++result.near;
        const double acrossX = (2.0 * x + 1 - kWidth) / kWidth, acrossY = (kHeight - 2.0 * y - 1) / kHeight;
        const dvec3 ray = forward + acrossX * tangent * kWidth / kHeight * right + acrossY * tangent * up;
        const dvec3 normal(frame.at(x, y, "normal.X"), frame.at(x, y, "normal.Y"), frame.at(x, y, "normal.Z"));
        const double depth = frame.at(x, y, "depth.Z");
        const auto hit = static_cast<std::size_t>(frame.at(x, y, "hit.id"));
        const dvec3 start = eye + surfaceAt(scene, eye, ray, depth, hit) * ray;
        const Crossing exact = crossing(scene, hit, start, glm::reflect(glm::normalize(ray), glm::normalize(normal)));
        result.own += !(exact.t > 0.1 * t);
      }
    }
    return result;
  }

 private:
  // The exact depth of the surface that a pixel shows, which is not that of the triangle `hit`.
  static double surfaceAt(const Scene& scene, const dvec3& eye, const dvec3& ray, double depth, std::size_t hit) {
    double nearest = depth, off = 1e-3 * depth;
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
      const Crossing c = crossing(scene, i, eye, ray);
      if (i == hit || !c.inside || std::abs(c.t - depth) >= off) continue;
      off = std::abs(c.t - depth);
      nearest = c.t;
    }
    return nearest;
  }
};

class NearHitsIn : public NearHitsTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(NearHitsIn, AreOfOtherSurfaces) {
  const std::filesystem::path file = sharedScene(std::string(GetParam()) + ".glb");
  HALFSILVER_REQUIRE_SCENE(file);
  const Scene scene = loadGltf(file).scene;
  const NearHits found = count(scene, scene.cameras.front());
  EXPECT_EQ(found.own, 0u) << "of " << found.near;
  EXPECT_GT(found.hits, 100u);
}

// Coincident copies of triangles, folds, seams, and scenes of all sizes.
INSTANTIATE_TEST_SUITE_P(Shared, NearHitsIn,
                         ::testing::Values("dragon", "primitives", "cloth_folds", "sponza", "desk_fan", "avocado",
                                           "low_poly_tree", "teapot", "suzanne", "bunny"),
                         [](const auto& scene) { return std::string(scene.param); });

TEST_F(NearHitsTest, OfTheAtriumAreContacts) {
  const Scene scene = makeBuiltin("atrium").scene;
  const NearHits found = count(scene, scene.cameras.front());
  EXPECT_EQ(found.own, 0u) << "of " << found.near;
  EXPECT_GT(found.near, 10u) << "none was gained";
}

// A die on a mirror, on land of any size: what the mirror shows of it ends where it stands.
TEST_F(NearHitsTest, TouchWhatStandsOnAMirrorHoweverLargeTheSceneIs) {
  const std::filesystem::path file = sharedCase("b21_die_on_mirror_1000");
  HALFSILVER_REQUIRE_SCENE(file);
  Scene scene = loadGltf(file).scene;
  const Camera camera = scene.cameras.front();
  for (const float size : {10.0f, 1e3f, 1e4f, 1e5f}) {
    for (const char* method : {"identity", "bvh", "exact"}) {
      if (std::string(method) == "exact" && !HALFSILVER_EXACT) continue;
      SCOPED_TRACE(::testing::Message() << method << ", " << size << " m");
      for (Vertex& vertex : scene.vertices)
        if (vertex.position.y < -0.4f)
          vertex.position *= glm::vec3(size / std::abs(vertex.position.x), 1, size / std::abs(vertex.position.z));
      const Frame frame = draw(scene, camera, settingsWith({{"trace.method", method}}), kWidth, kHeight);
      std::size_t die = 0;
      for (const float id : frame.plane("hit.id")) die += id >= 4;  // after land and mirror
      EXPECT_EQ(die, 4316u);
      EXPECT_LE(frame.report.minDistance, 1e-6f * size);
      EXPECT_GT(frame.report.minDistance, 0.0f);
    }
  }
}

}  // namespace
}  // namespace halfsilver::testing
