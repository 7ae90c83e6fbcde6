#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <halfsilver/builtin.h>
#include "unit/area_vector.h"

namespace halfsilver {
namespace {

using glm::dvec3;

class EffectScene : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Scenes, EffectScene, testing::ValuesIn(effectSceneNames()), [](const auto& scene) {
  std::string name = scene.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST_P(EffectScene, IsWholeAndNamed) {
  const Model model = makeBuiltin(GetParam());
  const Scene& scene = model.scene;
  EXPECT_EQ(scene.name, "builtin:" + GetParam());
  EXPECT_FALSE(scene.cameras.empty());
  std::set<std::uint32_t> used;
  for (const Triangle& t : scene.triangles) {
    used.insert(t.material);
    const dvec3 area = areaVector(scene, t);
    ASSERT_GT(glm::length(area), 1e-9);
    if (scene.materials[t.material].doubleSided) continue;
    for (const std::uint32_t index : t.vertices) ASSERT_GT(glm::dot(area, dvec3(scene.vertices[index].normal)), 0);
  }
  EXPECT_EQ(used.size(), scene.materials.size()) << "every material is used";
  ASSERT_TRUE(std::isfinite(scene.bounds().diagonal()));
}

// What is thick has an inside: its area vectors add up to nothing, and it is larger than nothing.
TEST_P(EffectScene, ThickGlassIsClosed) {
  const Scene scene = makeBuiltin(GetParam()).scene;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    if (scene.materials[m].transmission <= 0 || scene.materials[m].thickness <= 0) continue;
    dvec3 sum(0);
    double volume = 0, area = 0;
    for (const Triangle& t : scene.triangles) {
      if (t.material != m) continue;
      sum += areaVector(scene, t);
      area += glm::length(areaVector(scene, t));
      volume += glm::dot(areaVector(scene, t), dvec3(scene.vertices[t.vertices[0]].position));
    }
    EXPECT_LT(glm::length(sum), 1e-6 * area) << scene.materials[m].name;
    EXPECT_GT(volume, 0.01) << scene.materials[m].name;
  }
}

TEST(EffectScenes, AreasAreThoseOfTheirShapes) {
  const auto areaOf = [](const Scene& scene, const std::string& material) {
    double sum = 0;
    for (const Triangle& t : scene.triangles)
      if (scene.materials[t.material].name == material) sum += 0.5 * glm::length(areaVector(scene, t));
    return sum;
  };
  const Scene room = makeBuiltin("cornell-empty").scene;
  EXPECT_NEAR(areaOf(room, "white"), 12, 1e-5);
  EXPECT_NEAR(areaOf(room, "red"), 4, 1e-5);
  EXPECT_NEAR(areaOf(room, "green"), 4, 1e-5);
  EXPECT_GT(areaOf(makeBuiltin("cornell").scene, "white"), 12 + 4 * 0.6 * 1.2) << "the boxes stand in it";
  EXPECT_NEAR(areaOf(makeBuiltin("furnace").scene, "white"), 3.14159, 0.005);
  EXPECT_NEAR(areaOf(makeBuiltin("slab").scene, "glass"), 2 * 16 + 4 * 0.8, 1e-5);
  EXPECT_NEAR(areaOf(makeBuiltin("prism").scene, "glass"), 3 * 1.2 + 2 * 0.5 * std::sqrt(0.75), 1e-5);
}

}  // namespace
}  // namespace halfsilver
