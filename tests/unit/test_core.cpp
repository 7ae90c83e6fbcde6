#include <gtest/gtest.h>

#include <algorithm>

#include <halfsilver/builtin.h>
#include <halfsilver/scene_core.h>

namespace halfsilver {
namespace {

void addTriangle(Scene& scene, const glm::vec3& at, float size) {
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  for (const glm::vec3& corner : {glm::vec3(0), glm::vec3(size, 0, 0), glm::vec3(0, 0, size)}) {
    Vertex vertex;
    vertex.position = at + corner;
    scene.vertices.push_back(vertex);
  }
  scene.triangles.push_back({{first, first + 1, first + 2}, 0});
}

Scene row(int triangles) {
  Scene scene;
  for (int i = 0; i < triangles; ++i) addTriangle(scene, {0.1f * static_cast<float>(i), 0, 0}, 0.05f);
  return scene;
}

TEST(SceneCore, AGroundToTheHorizonIsOuter) {
  Scene scene = row(100);
  addTriangle(scene, {-500, 0, -500}, 1000);
  addTriangle(scene, {2, 0, 0.01f}, 1);  // also large, but inside
  const SceneCore core = SceneExtents(scene).core();
  EXPECT_EQ(core.outer, std::vector<std::uint32_t>({100, 101}));
  EXPECT_FLOAT_EQ(core.bounds.low.x, 0);
  EXPECT_FLOAT_EQ(core.bounds.high.x, 9.95f);
  EXPECT_FLOAT_EQ(core.bounds.high.z, 0.05f);
}

TEST(SceneCore, MoreLargeTrianglesThanMayBeOuterStay) {
  Scene scene = row(100);
  for (std::size_t i = 0; i <= kMaxOuterTriangles; ++i) addTriangle(scene, {-500, 0, -500}, 1000);
  const SceneCore core = SceneExtents(scene).core();
  EXPECT_TRUE(core.outer.empty());
  EXPECT_FLOAT_EQ(core.bounds.low.x, -500);
}

TEST(SceneCore, OrdinaryScenesAreWhole) {
  for (const char* name : {"sphere", "teapot", "atrium"}) {
    const Model model = makeBuiltin(name);
    const SceneCore core = SceneExtents(model.scene).core();
    EXPECT_TRUE(core.outer.empty()) << name;
    EXPECT_EQ(core.bounds.low, model.scene.bounds().low) << name;
    EXPECT_EQ(core.bounds.high, model.scene.bounds().high) << name;
  }
}

TEST(SceneCore, FewTrianglesAreWhole) {
  EXPECT_TRUE(SceneExtents(Scene{}).core().bounds.empty());
  const Scene scene = row(3);
  EXPECT_TRUE(SceneExtents(scene).core().outer.empty());
  EXPECT_EQ(SceneExtents(scene).core().bounds.high, scene.bounds().high);
}

}  // namespace
}  // namespace halfsilver
