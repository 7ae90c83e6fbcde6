#include <gtest/gtest.h>

#include <cmath>

#include <halfsilver/io.h>
#include "shared_scenes.h"

// The shared scenes against what their README says about them.
namespace halfsilver::testing {
namespace {

struct Expected {
  const char* name;
  std::size_t triangles;   // as stored, or as placed if a mesh is placed twice
  std::size_t degenerate;  // two equal corners, or all three on a line
};

void PrintTo(const Expected& scene, std::ostream* stream) { *stream << scene.name; }

class SharedScene : public ::testing::TestWithParam<Expected> {};

TEST_P(SharedScene, LoadsWhole) {
  const Expected& expected = GetParam();
  const auto path = sharedScene(std::string(expected.name) + ".glb");
  HALFSILVER_REQUIRE_SCENE(path);
  const Model model = loadGltf(path);
  const Scene& scene = model.scene;
  EXPECT_EQ(scene.triangles.size() + model.dropped.degenerate, expected.triangles);
  EXPECT_EQ(model.dropped.degenerate, expected.degenerate);
  EXPECT_EQ(model.dropped.nonFinite, 0u);
  std::size_t counted = 0;
  for (const Part& part : model.parts) {
    EXPECT_EQ(part.firstTriangle, counted);
    counted += part.triangleCount;
  }
  EXPECT_EQ(counted, scene.triangles.size());
  for (const Triangle& triangle : scene.triangles) {
    ASSERT_LT(triangle.material, scene.materials.size());
    for (const std::uint32_t index : triangle.vertices) ASSERT_LT(index, scene.vertices.size());
  }
  for (const Vertex& vertex : scene.vertices) {
    ASSERT_LT(glm::length(vertex.position), 1e4f);
    ASSERT_NEAR(glm::length(vertex.normal), 1, 1e-4);
    ASSERT_NEAR(glm::length(glm::vec3(vertex.tangent)), 1, 1e-4);
    ASSERT_EQ(std::abs(vertex.tangent.w), 1);
    for (const glm::vec2& uv : vertex.uv) ASSERT_LT(glm::length(uv), 1e4f);
  }
  for (const auto& texture : scene.textures)
    EXPECT_EQ(texture->texels.size(), static_cast<std::size_t>(4 * texture->width * texture->height));
}

INSTANTIATE_TEST_SUITE_P(Shared, SharedScene,
                         ::testing::Values(Expected{"sponza", 262267, 428}, Expected{"sponza_foliage", 34940, 0},
                                           Expected{"bunny", 69451, 0}, Expected{"dragon", 202520, 0},
                                           Expected{"teapot", 6320, 0}, Expected{"suzanne", 3936, 0},
                                           Expected{"avocado", 682, 0}, Expected{"fox", 576, 0},
                                           Expected{"rigged_figure", 256, 0}, Expected{"box_animated", 254, 0},
                                           Expected{"animated_morph_cube", 12, 0},
                                           Expected{"milk_truck", 2856 + 768, 0}, Expected{"desk_fan", 21080, 0},
                                           Expected{"cloth_folds", 76832, 0}, Expected{"two_sided_plane", 2, 0},
                                           Expected{"primitives", 3636, 0}, Expected{"low_poly_tree", 1126, 0}),
                         [](const auto& scene) { return std::string(scene.param.name); });

}  // namespace
}  // namespace halfsilver::testing
