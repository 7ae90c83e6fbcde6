#include <gtest/gtest.h>

#include <memory>

#include "scene/alpha.h"

namespace halfsilver {
namespace {

// Two by two texels: opaque, half, clear, opaque.
Scene leaf() {
  auto texture = std::make_shared<Texture>();
  texture->width = texture->height = 2;
  texture->texels = {0, 0, 0, 255, 0, 0, 0, 128, 0, 0, 0, 0, 0, 0, 0, 255};
  Material material;
  material.alphaMode = AlphaMode::mask;
  material.baseColorTexture.texture = 0;
  Scene scene;
  scene.textures = {texture};
  scene.materials = {material};
  scene.vertices.resize(3);
  scene.vertices[1].position = {1, 0, 0};
  scene.vertices[1].uv[0] = {1, 0};
  scene.vertices[2].position = {0, 1, 0};
  scene.vertices[2].uv[0] = {0, 1};
  scene.triangles = {{{0, 1, 2}, 0}};
  return scene;
}

TEST(Alpha, TexelCentersGiveTheTexel) {
  Scene scene = leaf();
  EXPECT_FALSE(cutAway(scene, 0, {0.25f, 0.25f}));  // 255
  EXPECT_FALSE(cutAway(scene, 0, {0.75f, 0.25f}));  // 128, just above 0.5
  EXPECT_TRUE(cutAway(scene, 0, {0.25f, 0.75f}));   // 0
  scene.materials[0].alphaCutoff = 0.51f;
  EXPECT_TRUE(cutAway(scene, 0, {0.75f, 0.25f}));
}

TEST(Alpha, IsInterpolatedBetweenTexels) {
  Scene scene = leaf();
  // From 255 at v = 0.25 to 0 at v = 0.75: one half is at v = 0.5.
  EXPECT_FALSE(cutAway(scene, 0, {0.25f, 0.49f}));
  EXPECT_TRUE(cutAway(scene, 0, {0.25f, 0.51f}));
  scene.materials[0].baseColorTexture.magnify = Filter::nearest;
  EXPECT_FALSE(cutAway(scene, 0, {0.1f, 0.499f}));
  EXPECT_TRUE(cutAway(scene, 0, {0.1f, 0.501f}));
}

TEST(Alpha, WrapModes) {
  Scene scene = leaf();
  TextureUse& use = scene.materials[0].baseColorTexture;
  use.magnify = Filter::nearest;
  const auto holeAt = [&](float v, Wrap wrap) {
    use.wrapV = wrap;
    use.transform[0] = {0, 0, 0.25f};  // the left column: 255 above 0
    use.transform[1] = {0, 0, v};
    return cutAway(scene, 0, {0.2f, 0.2f});
  };
  for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp}) {
    EXPECT_FALSE(holeAt(0.25f, wrap));
    EXPECT_TRUE(holeAt(0.75f, wrap));
  }
  EXPECT_FALSE(holeAt(1.25f, Wrap::repeat));
  EXPECT_TRUE(holeAt(1.25f, Wrap::mirror));
  EXPECT_TRUE(holeAt(1.25f, Wrap::clamp));
  EXPECT_TRUE(holeAt(-0.25f, Wrap::repeat));
  EXPECT_FALSE(holeAt(-0.25f, Wrap::mirror));
  EXPECT_FALSE(holeAt(-0.25f, Wrap::clamp));
  EXPECT_FALSE(holeAt(2.25f, Wrap::mirror));
  EXPECT_TRUE(holeAt(-1e9f - 0.25f, Wrap::clamp) != holeAt(1e9f, Wrap::clamp));
}

TEST(Alpha, NonFiniteCoordinatesReadATexel) {
  Scene scene = leaf();
  TextureUse& use = scene.materials[0].baseColorTexture;
  use.transform[0] = {0, 0, std::numeric_limits<float>::infinity()};
  use.transform[1] = {0, 0, std::numeric_limits<float>::quiet_NaN()};
  for (const Wrap wrap : {Wrap::repeat, Wrap::mirror}) {
    use.wrapU = use.wrapV = wrap;
    // The corner of the texture: repeated, the mean of all four; mirrored, the first texel.
    EXPECT_FALSE(cutAway(scene, 0, {0.2f, 0.2f}));
  }
}

TEST(Alpha, FactorAndVertexColor) {
  Scene scene = leaf();
  scene.materials[0].baseColor.a = 0.4f;
  EXPECT_TRUE(cutAway(scene, 0, {0.25f, 0.25f}));
  scene.materials[0].alphaMode = AlphaMode::blend;  // the factor no longer counts
  EXPECT_FALSE(cutAway(scene, 0, {0.25f, 0.25f}));
  EXPECT_TRUE(cutAway(scene, 0, {0.25f, 0.75f}));
  for (Vertex& vertex : scene.vertices) vertex.color.a = 0.4f;
  EXPECT_TRUE(cutAway(scene, 0, {0.25f, 0.25f}));
  // Blended, only what is clear is a hole, and the factor counts again.
  EXPECT_FALSE(cutAway(scene, 0, {0.25f, 0.25f}, true));
  EXPECT_TRUE(cutAway(scene, 0, {0.25f, 0.75f}, true));
  scene.materials[0].baseColor.a = 0;
  EXPECT_TRUE(cutAway(scene, 0, {0.25f, 0.25f}, true));
  EXPECT_TRUE(translucencyOf(scene).holes[0]);
  scene.materials[0].alphaMode = AlphaMode::opaque;
  EXPECT_FALSE(cutAway(scene, 0, {0.25f, 0.75f}));
}

TEST(Alpha, MaterialsWithHoles) {
  Scene scene = leaf();
  auto solid = std::make_shared<Texture>(*scene.textures[0]);
  for (std::size_t i = 3; i < solid->texels.size(); i += 4) solid->texels[i] = 255;
  scene.textures.push_back(solid);
  Material opaque, full = scene.materials[0], plain = scene.materials[0];
  full.baseColorTexture.texture = 1;
  plain.baseColorTexture.texture = -1;
  plain.baseColor.a = 0.3f;
  scene.materials.insert(scene.materials.end(), {opaque, full, plain});
  for (std::uint32_t m = 1; m < 4; ++m) scene.triangles.push_back({{0, 1, 2}, m});
  EXPECT_EQ(translucencyOf(scene).holes, (std::vector<bool>{true, false, false, true}));
  scene.vertices[1].color.a = 0.1f;
  EXPECT_EQ(translucencyOf(scene).holes, (std::vector<bool>{true, false, true, true}));
}

}  // namespace
}  // namespace halfsilver
