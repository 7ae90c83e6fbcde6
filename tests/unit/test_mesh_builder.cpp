#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "builtin/parts.h"
#include "unit/area_vector.h"

// The pieces that scenes made in code are put together from.
namespace halfsilver {
namespace {

using glm::dvec3;
using glm::vec3;

TEST(MeshBuilderPieces, CornersOfABoxFaceOutward) {
  MeshBuilder build;
  build.use(0).box({-1, -2, -3}, {1, 2, 3});
  build.roundedBox({10, 0, 0}, {2, 4, 6}, 0.5, 3, 0.7);
  const Mesh mesh = build.take();
  Scene scene;
  setMesh(scene, mesh);
  ASSERT_EQ(scene.triangles.size(), 12u + 6u * 7 * 7 * 2);
  double volume = 0, boxVolume = 0;  // divergence theorem
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    const Triangle& t = scene.triangles[i];
    (i < 12 ? boxVolume : volume) += glm::dot(dvec3(scene.vertices[t.vertices[0]].position), areaVector(scene, t)) / 6;
  }
  EXPECT_NEAR(boxVolume, 48, 1e-4);
  // Rounding cuts the twelve edges and eight corners: quarter cylinders and a sphere remain.
  const double r = 0.5;
  const double exact =
      48 - (4 - kPi) * r * r * ((2 - 2 * r) + (4 - 2 * r) + (6 - 2 * r)) - (8 * r * r * r - 4.0 / 3 * kPi * r * r * r);
  EXPECT_LT(volume, exact);
  EXPECT_NEAR(volume, exact, 0.1);
}

TEST(MeshBuilderPieces, ALatheOfAnArcIsASphere) {
  MeshBuilder build;
  build.lathe(Profile().arc({0, 0}, 2, 0.5 * kPi, -0.5 * kPi, 60), {5, 6, 7}, 120);
  Scene scene;
  setMesh(scene, build.take());
  double volume = 0, area = 0;
  for (const Triangle& t : scene.triangles) {
    volume += glm::dot(dvec3(scene.vertices[t.vertices[0]].position) - dvec3(5, 6, 7), areaVector(scene, t)) / 6;
    area += 0.5 * glm::length(areaVector(scene, t));
  }
  EXPECT_NEAR(volume / (32.0 / 3 * kPi), 1, 0.002);
  EXPECT_NEAR(area / (16 * kPi), 1, 0.002);
}

TEST(MeshBuilderPieces, AnArchedWallHasTheAreaOfItsOutline) {
  MeshBuilder build;
  build.archedWall({3, 4, 5}, {0, 0, 1}, {0, 1, 0}, 2, 2.5, 1.5, 64);
  Scene scene;
  setMesh(scene, build.take());
  dvec3 area(0);
  for (const Triangle& t : scene.triangles) area += 0.5 * areaVector(scene, t);
  EXPECT_NEAR(area.x, -(4 * 2.5 - 0.5 * kPi * 1.5 * 1.5), 0.005);
  EXPECT_NEAR(area.y, 0, 1e-6);
  EXPECT_NEAR(area.z, 0, 1e-6);
}

TEST(MeshBuilderPieces, TubesAreClosed) {
  const std::array<dvec3, 2> straight{dvec3(1, 2, 3), dvec3(1, 2, 5)};
  const std::array<dvec3, 3> bent{dvec3(0, 0, 0), dvec3(1, 0, 0), dvec3(2, 1, 0)};
  for (const std::span<const dvec3> points : {std::span<const dvec3>(straight), std::span<const dvec3>(bent)}) {
    MeshBuilder build;
    build.tube(points, 0.1, 12, points.size() == 2 ? dvec3(1, 0, 0) : dvec3(0, 0, 1));
    Scene scene;
    setMesh(scene, build.take());
    dvec3 total(0);
    double volume = 0;
    for (const Triangle& t : scene.triangles) {
      total += areaVector(scene, t);
      volume += glm::dot(dvec3(scene.vertices[t.vertices[0]].position), areaVector(scene, t)) / 6;
    }
    EXPECT_LT(glm::length(total), 1e-6);
    EXPECT_GT(volume, 0);
    // A regular polygon of twelve corners, two meters long.
    if (points.size() == 2) {
      EXPECT_NEAR(volume, 6 * 0.01 * std::sin(kPi / 6) * 2, 1e-5);
    }
  }
}

}  // namespace
}  // namespace halfsilver
