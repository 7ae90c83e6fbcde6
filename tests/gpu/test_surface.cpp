#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "frame/frame_constants.h"
#include "frame/gpu_scene.h"
#include "frame/pack_material.h"
#include "gpu/context_fixture.h"
#include "gpu/shader_function.h"

namespace halfsilver {
namespace {

using testing::addQuad;
using testing::plainTexture;
using testing::ShaderFunction;

// Glass under a coat, with every field away from its default.
Material layered() {
  Material material;
  material.metallic = 0;
  material.ior = 1.7f;
  material.transmission = 0.75f;
  material.thickness = 0.5f;
  material.attenuationColor = {0.25f, 0.5f, 1};
  material.attenuationDistance = 2;
  material.dispersion = 0.4f;
  material.coat = 0.5f;
  material.coatRoughness = 0.25f;
  return material;
}

struct Layers {
  float transmission, ior, dispersion, thickness, coat, coatRoughness, reflectivity;
  bool thin;
  glm::vec3 absorption, coatNormal, normal;
};

// What evaluateSurface() says of the middle of a square that faces +z, seen along -z.
class SurfaceTest : public testing::ContextTest {
 protected:
  Layers evaluate(const Material& material, const std::vector<std::shared_ptr<const Texture>>& textures = {},
                  const char* which = "ALL_TEXTURES") const {
    Scene scene;
    scene.textures = textures;
    scene.materials = {material};
    addQuad(scene, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, 0);
    const GpuScene gpu = uploadScene(api, scene);
    gpu.bindSurfaces();
    const shared::FrameConstants frame =
        makeFrameConstants(frameAll(gpu.extents.bounds()), gpu.extents.bounds(), scene.sky, Settings{}, 16, 16, {});
    const gl::Buffer constants = gl::makeBuffer(api, std::span<const shared::FrameConstants>(&frame, 1), "frame");
    constants.bindUniform(UBO_FRAME);
    const ShaderFunction function(api, "lib/evaluate_surface.glsl",
                                  "Surface s = evaluateSurface(0u, inputs[item].xy, vec3(0.0, 0.0, -1.0), 1e-3, " +
                                      std::string(which) +
                                      ");\n"
                                      "uint o = 5u * item;\n"
                                      "outputs[o] = vec4(s.transmission, s.ior, s.dispersion, s.thickness);\n"
                                      "outputs[o + 1u] = vec4(s.coat, s.coatRoughness, s.reflectivity, s.thin);\n"
                                      "outputs[o + 2u] = vec4(s.absorption, 0.0);\n"
                                      "outputs[o + 3u] = vec4(s.coatNormal, 0.0);\n"
                                      "outputs[o + 4u] = vec4(s.normal, 0.0);\n",
                                  1, 5);
    const std::vector<glm::vec4> o = function.run({glm::vec4(0.25f, 0.5f, 0, 0)});
    return {o[0].x, o[0].y,         o[0].z,          o[0].w,          o[1].x,         o[1].y,
            o[1].z, o[1].w != 0.0f, glm::vec3(o[2]), glm::vec3(o[3]), glm::vec3(o[4])};
  }
};

TEST_F(SurfaceTest, LayersAreWhatTheMaterialSays) {
  const Layers s = evaluate(layered());
  EXPECT_EQ(s.transmission, 0.75f);
  EXPECT_EQ(s.ior, 1.7f);
  EXPECT_EQ(s.dispersion, 0.4f);
  EXPECT_EQ(s.thickness, 0.5f);
  EXPECT_FALSE(s.thin);
  EXPECT_EQ(s.coat, 0.5f);
  EXPECT_EQ(s.coatRoughness, 0.25f);
  // After the distance the color is left.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(std::exp(-2 * s.absorption[c]), layered().attenuationColor[c], 1e-6f);
}

TEST_F(SurfaceTest, LayersMultiplyTheirTextures) {
  Material material = layered();
  for (TextureUse* use : {&material.transmissionTexture, &material.thicknessTexture, &material.coatTexture,
                          &material.coatRoughnessTexture})
    use->texture = 0;
  const auto texture = plainTexture(4, 4, {51, 102, 153, 204}, false);
  const Layers s = evaluate(material, {texture});
  EXPECT_NEAR(s.transmission, 0.75f * 0.2f, 1e-6f) << "red";
  EXPECT_NEAR(s.thickness, 0.5f * 0.4f, 1e-6f) << "green";
  EXPECT_NEAR(s.coat, 0.5f * 0.2f, 1e-6f) << "red";
  EXPECT_NEAR(s.coatRoughness, 0.25f * 0.4f, 1e-6f) << "green";
  const Layers base = evaluate(material, {texture}, "BASE_TEXTURES");
  EXPECT_EQ(base.transmission, 0.75f) << "not asked for";
  EXPECT_EQ(base.coat, 0.5f);
}

TEST_F(SurfaceTest, TheCoatHasANormalOfItsOwn) {
  Material material = layered();
  const auto tilted = plainTexture(4, 4, {204, 128, 255, 255}, false);  // towards the tangent, +x
  material.normalTexture.texture = 0;
  const Layers base = evaluate(material, {tilted});
  EXPECT_GT(base.normal.x, 0.4f);
  EXPECT_LT(glm::distance(base.coatNormal, glm::vec3(0, 0, 1)), 1e-6f) << "the base's map is not the coat's";
  material.normalTexture.texture = -1;
  material.coatNormalTexture.texture = 0;
  const Layers coat = evaluate(material, {tilted});
  EXPECT_LT(glm::distance(coat.normal, glm::vec3(0, 0, 1)), 1e-6f);
  EXPECT_LT(glm::distance(coat.coatNormal, base.normal), 1e-6f) << "the same map, the same normal";
  material.coatNormalScale = 0;
  EXPECT_NEAR(evaluate(material, {tilted}).coatNormal.z, 1, 1e-6f);
}

TEST_F(SurfaceTest, AWallWithoutThicknessIsThinAndAbsorbsNothing) {
  Material material = layered();
  material.thickness = 0;
  const Layers s = evaluate(material);
  EXPECT_TRUE(s.thin);
  EXPECT_EQ(s.absorption, glm::vec3(0));
  material.transmission = 0;
  EXPECT_FALSE(evaluate(material).thin) << "it is no wall of glass";
}

TEST_F(SurfaceTest, AbsorptionIsFinite) {
  Material material = layered();
  material.attenuationColor = {0, 1, 0.5f};
  material.attenuationDistance = 0;
  const Layers black = evaluate(material);
  for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(black.absorption[c])) << c;
  EXPECT_EQ(std::exp(-1e-3f * black.absorption.x), 0);
  EXPECT_EQ(black.absorption.y, 0);
  material.attenuationDistance = std::numeric_limits<float>::infinity();
  EXPECT_EQ(evaluate(material).absorption, glm::vec3(0));
}

TEST_F(SurfaceTest, MirrorsAndUnlitSurfacesHaveNoLayers) {
  Material mirror = layered(), unlit = layered();
  mirror.mirror = 0.5f;
  unlit.unlit = true;
  for (const Material& material : {mirror, unlit}) {
    const Layers s = evaluate(material);
    EXPECT_EQ(s.transmission, 0);
    EXPECT_EQ(s.coat, 0);
    EXPECT_FALSE(s.thin);
  }
}

TEST(PackMaterial, FlagsSayWhichLayersAndTexturesThereAre) {
  const auto flags = [](const Material& material) {
    return packMaterial(material, false, {}, std::vector<std::uint32_t>{0}).flags;
  };
  Material material = layered();
  // A ray inside a volume meets the backs of its walls; a thin wall has none.
  EXPECT_EQ(flags(material), MATERIAL_TRANSMISSIVE | MATERIAL_COATED | MATERIAL_DOUBLE_SIDED);
  material.thickness = 0;
  EXPECT_EQ(flags(material), MATERIAL_TRANSMISSIVE | MATERIAL_THIN | MATERIAL_COATED);
  material.transmissionTexture.texture = 0;
  material.coatNormalTexture.texture = 0;
  const std::uint32_t glass = 1u << (MATERIAL_TEXTURES_SHIFT + TEXTURE_TRANSMISSION);
  const std::uint32_t coat = 1u << (MATERIAL_TEXTURES_SHIFT + TEXTURE_CLEARCOAT_NORMAL);
  EXPECT_EQ(flags(material) >> MATERIAL_TEXTURES_SHIFT, (glass | coat) >> MATERIAL_TEXTURES_SHIFT);
  material.coat = 0;
  EXPECT_EQ(flags(material), MATERIAL_TRANSMISSIVE | MATERIAL_THIN | glass) << "no coat, so its map is not read";
  material.transmission = 0;
  EXPECT_EQ(flags(material), 0u);
  material = layered();
  material.mirror = 0.5f;
  EXPECT_EQ(flags(material), MATERIAL_MIRROR);
}

}  // namespace
}  // namespace halfsilver
