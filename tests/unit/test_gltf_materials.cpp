#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include "gltf_loading.h"
#include "scene/tangents.h"
#include "shared_scenes.h"

namespace halfsilver::testing {
namespace {

// A square facing +z with its texture upright: v = 0 at the top edge.
GltfFile square() {
  GltfFile file;
  json& primitive =
      file.primitive({{"POSITION", file.accessor(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3")},
                      {"NORMAL", file.accessor(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")},
                      {"TEXCOORD_0", file.accessor(std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0}, "VEC2")}});
  primitive["indices"] = file.accessor(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR");
  primitive["material"] = 0;
  return file;
}

GltfFile textured(json material, json sampler = json::object()) {
  GltfFile file = square();
  file.add("images", {{"bufferView", file.view(smallPng())}, {"mimeType", "image/png"}, {"name", "patches"}});
  file.add("samplers", std::move(sampler));
  file.add("textures", {{"source", 0}, {"sampler", 0}});
  file.add("materials", std::move(material));
  return file;
}

TEST(GltfMaterial, FactorsAndFlags) {
  GltfFile file = square();
  file.add("materials",
           {{"name", "thing"},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.25}}},
            {"emissiveFactor", {0.5, 0.25, 1}},
            {"alphaMode", "MASK"},
            {"alphaCutoff", 0.3},
            {"doubleSided", true},
            {"extensions",
             {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}},
              {"KHR_materials_ior", {{"ior", 1.33}}},
              {"KHR_materials_specular", {{"specularFactor", 0.5}, {"specularColorFactor", {1, 0.5, 2}}}},
              {"KHR_materials_unlit", json::object()}}}});
  const Model model = load(file);
  const Material& material = model.scene.materials.at(0);
  EXPECT_EQ(material.name, "thing");
  EXPECT_EQ(material.baseColor, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(material.metallic, 0.5f);
  EXPECT_EQ(material.roughness, 0.25f);
  EXPECT_EQ(material.emissive, glm::vec3(4, 2, 8));
  EXPECT_EQ(material.alphaMode, AlphaMode::mask);
  EXPECT_EQ(material.alphaCutoff, 0.3f);
  EXPECT_TRUE(material.doubleSided);
  EXPECT_TRUE(material.unlit);
  EXPECT_EQ(material.ior, 1.33f);
  EXPECT_EQ(material.specular, 0.5f);
  EXPECT_EQ(material.specularColor, glm::vec3(1, 0.5f, 2));
}

TEST(GltfMaterial, TransmissionAndVolume) {
  GltfFile file = square();
  file.root["extensionsRequired"] = {"KHR_materials_transmission", "KHR_materials_volume", "KHR_materials_dispersion"};
  file.root["extensionsUsed"] = file.root["extensionsRequired"];
  file.add("materials",
           {{"extensions",
             {{"KHR_materials_transmission", {{"transmissionFactor", 0.75}}},
              {"KHR_materials_volume",
               {{"thicknessFactor", 0.5}, {"attenuationDistance", 2.5}, {"attenuationColor", {0.25, 0.5, 1}}}},
              {"KHR_materials_dispersion", {{"dispersion", 0.4}}}}}});
  const Model model = load(file);
  const Material& material = model.scene.materials.at(0);
  EXPECT_EQ(material.transmission, 0.75f);
  EXPECT_EQ(material.thickness, 0.5f);
  EXPECT_EQ(material.attenuationDistance, 2.5f);
  EXPECT_EQ(material.attenuationColor, glm::vec3(0.25f, 0.5f, 1));
  EXPECT_EQ(material.dispersion, 0.4f);
  EXPECT_FALSE(warns(model, "extension"));
  EXPECT_FALSE(warns(model, "KHR_"));
}

TEST(GltfMaterial, Clearcoat) {
  GltfFile file = square();
  file.root["extensionsRequired"] = {"KHR_materials_clearcoat"};
  file.root["extensionsUsed"] = file.root["extensionsRequired"];
  file.add("materials",
           {{"extensions",
             {{"KHR_materials_clearcoat", {{"clearcoatFactor", 0.75}, {"clearcoatRoughnessFactor", 0.125}}}}}});
  const Model model = load(file);
  EXPECT_EQ(model.scene.materials.at(0).coat, 0.75f);
  EXPECT_EQ(model.scene.materials.at(0).coatRoughness, 0.125f);
  EXPECT_EQ(model.scene.materials.at(0).coatNormalScale, 1);
  EXPECT_FALSE(warns(model, "extension"));
}

TEST(GltfMaterial, SheenAndAnisotropy) {
  const json info = {{"index", 0}, {"texCoord", 1}};
  GltfFile file =
      textured({{"extensions",
                 {{"KHR_materials_sheen",
                   {{"sheenColorFactor", {0.25, 0.5, 1}},
                    {"sheenRoughnessFactor", 0.75},
                    {"sheenColorTexture", info},
                    {"sheenRoughnessTexture", info}}},
                  {"KHR_materials_anisotropy",
                   {{"anisotropyStrength", 0.5}, {"anisotropyRotation", 1.25}, {"anisotropyTexture", info}}}}}});
  file.root["extensionsRequired"] = {"KHR_materials_sheen", "KHR_materials_anisotropy"};
  file.root["extensionsUsed"] = file.root["extensionsRequired"];
  const Model model = load(file);
  const Material& material = model.scene.materials.at(0);
  EXPECT_EQ(material.sheenColor, glm::vec3(0.25f, 0.5f, 1));
  EXPECT_EQ(material.sheenRoughness, 0.75f);
  EXPECT_EQ(material.anisotropy, 0.5f);
  EXPECT_EQ(material.anisotropyRotation, 1.25f);
  for (const TextureUse* use :
       {&material.sheenColorTexture, &material.sheenRoughnessTexture, &material.anisotropyTexture}) {
    EXPECT_GE(use->texture, 0);
    EXPECT_EQ(use->uvSet, 1);
  }
  EXPECT_TRUE(model.scene.textures.at(static_cast<std::size_t>(material.sheenColorTexture.texture))->srgb);
  EXPECT_FALSE(model.scene.textures.at(static_cast<std::size_t>(material.anisotropyTexture.texture))->srgb);
  EXPECT_FALSE(warns(model, "extension"));
  EXPECT_FALSE(warns(model, "KHR_"));
}

// The square's u grows along x: that is its direction, whatever the texture coordinates' turn says elsewhere.
TEST(GltfMaterial, AnisotropyTakesItsDirectionFromTextureCoordinates) {
  GltfFile file = square();
  file.add("materials", {{"extensions", {{"KHR_materials_anisotropy", {{"anisotropyStrength", 0.5}}}}}});
  const Model model = load(file);
  for (const Vertex& vertex : model.scene.vertices) {
    EXPECT_NEAR(vertex.tangent.x, 1, 1e-6f);
    EXPECT_EQ(vertex.tangent.w, 1);
  }
}

TEST(GltfMaterial, LayersThatAreNotNamedAreNotThere) {
  GltfFile file = square();
  file.add("materials", {{"name", "plain"}});
  file.add("materials", {{"extensions",
                          {{"KHR_materials_transmission", json::object()},
                           {"KHR_materials_volume", json::object()},
                           {"KHR_materials_dispersion", json::object()},
                           {"KHR_materials_sheen", json::object()},
                           {"KHR_materials_anisotropy", json::object()},
                           {"KHR_materials_clearcoat", json::object()}}}});
  for (const Material& material : load(file).scene.materials) {
    EXPECT_EQ(material.transmission, 0);
    EXPECT_EQ(material.thickness, 0);
    EXPECT_TRUE(std::isinf(material.attenuationDistance));
    EXPECT_EQ(material.attenuationColor, glm::vec3(1));
    EXPECT_EQ(material.dispersion, 0);
    EXPECT_EQ(material.coat, 0);
    EXPECT_EQ(material.coatRoughness, 0);
    EXPECT_EQ(material.coatNormalTexture.texture, -1);
    EXPECT_EQ(material.sheenColor, glm::vec3(0));
    EXPECT_EQ(material.anisotropy, 0);
  }
}

TEST(GltfMaterial, LayersBeyondTheirRangeAreClampedAndNamed) {
  GltfFile file = square();
  file.add("materials",
           {{"extensions",
             {{"KHR_materials_transmission", {{"transmissionFactor", 1.5}}},
              {"KHR_materials_volume",
               {{"thicknessFactor", -1}, {"attenuationDistance", 0}, {"attenuationColor", {0.5, -1, 2}}}},
              {"KHR_materials_dispersion", {{"dispersion", -0.1}}},
              {"KHR_materials_sheen", {{"sheenColorFactor", {2, 0, -1}}, {"sheenRoughnessFactor", 1.5}}},
              {"KHR_materials_anisotropy", {{"anisotropyStrength", 4}, {"anisotropyRotation", 1e30}}},
              {"KHR_materials_clearcoat", {{"clearcoatFactor", -0.5}, {"clearcoatRoughnessFactor", 3}}}}}});
  const Model model = load(file);
  const Material& material = model.scene.materials.at(0);
  EXPECT_EQ(material.transmission, 1);
  EXPECT_EQ(material.thickness, 0);
  EXPECT_GT(material.attenuationDistance, 0);
  EXPECT_EQ(material.attenuationColor, glm::vec3(0.5f, 0, 1));
  EXPECT_EQ(material.dispersion, 0);
  EXPECT_EQ(material.coat, 0);
  EXPECT_EQ(material.coatRoughness, 1);
  EXPECT_EQ(material.sheenColor, glm::vec3(1, 0, 0));
  EXPECT_EQ(material.sheenRoughness, 1);
  EXPECT_EQ(material.anisotropy, 1);
  for (const char* field : {"transmissionFactor", "thicknessFactor", "attenuationDistance", "attenuationColor",
                            "dispersion", "clearcoatFactor", "clearcoatRoughnessFactor", "sheenColorFactor",
                            "sheenRoughnessFactor", "anisotropyStrength", "anisotropyRotation"})
    EXPECT_TRUE(warns(model, std::string(field) + " is out of range and was clamped: materials[0]")) << field;
}

TEST(GltfMaterial, TexturesOfLayersAreData) {
  const json info = {{"index", 0}, {"texCoord", 1}};
  const Model model =
      load(textured({{"extensions",
                      {{"KHR_materials_transmission", {{"transmissionFactor", 1}, {"transmissionTexture", info}}},
                       {"KHR_materials_volume", {{"thicknessFactor", 1}, {"thicknessTexture", info}}},
                       {"KHR_materials_clearcoat",
                        {{"clearcoatFactor", 1},
                         {"clearcoatTexture", info},
                         {"clearcoatRoughnessTexture", info},
                         {"clearcoatNormalTexture", {{"index", 0}, {"scale", 0.5}}}}}}}}));
  const Material& material = model.scene.materials.at(0);
  EXPECT_EQ(material.coatNormalScale, 0.5f);
  EXPECT_EQ(material.coatNormalTexture.uvSet, 0);
  ASSERT_EQ(model.scene.textures.size(), 1u);
  EXPECT_FALSE(model.scene.textures[0]->srgb);
  for (const TextureUse* use : {&material.transmissionTexture, &material.thicknessTexture, &material.coatTexture,
                                &material.coatRoughnessTexture}) {
    EXPECT_EQ(use->texture, 0);
    EXPECT_EQ(use->uvSet, 1);
  }
  EXPECT_EQ(material.coatNormalTexture.texture, 0);
  EXPECT_EQ(material.normalTexture.texture, -1);
}

TEST(GltfMaterial, ATextureOfALayerThatDoesNotExistIsNamed) {
  GltfFile file = textured(
      {{"extensions",
        {{"KHR_materials_clearcoat", {{"clearcoatFactor", 1}, {"clearcoatRoughnessTexture", {{"index", 7}}}}}}}});
  try {
    load(file);
    FAIL() << "loaded";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::badInput);
    EXPECT_NE(std::string(error.what()).find("materials[0].clearcoatRoughnessTexture"), std::string::npos)
        << error.what();
  }
}

TEST(GltfMaterial, BlendLoadsWithoutAWarning) {
  GltfFile file = square();
  file.add("materials", {{"name", "glass"}, {"alphaMode", "BLEND"}});
  const Model model = load(file);
  EXPECT_EQ(model.scene.materials[0].alphaMode, AlphaMode::blend);
  EXPECT_FALSE(warns(model, "BLEND"));
}

TEST(GltfMaterial, TexelsAndSampler) {
  const Model model = load(textured({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}},
                                    {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}, {"minFilter", 9984}}));
  ASSERT_EQ(model.scene.textures.size(), 1u);
  const Texture& texture = *model.scene.textures[0];
  EXPECT_EQ(texture.name, "patches");
  EXPECT_TRUE(texture.srgb);
  ASSERT_EQ(texture.width, 2);
  ASSERT_EQ(texture.height, 2);
  const std::vector<std::uint8_t> texels = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 128};
  EXPECT_EQ(texture.texels, texels);
  const TextureUse& use = model.scene.materials[0].baseColorTexture;
  EXPECT_EQ(use.texture, 0);
  EXPECT_EQ(use.wrapU, Wrap::clamp);
  EXPECT_EQ(use.wrapV, Wrap::mirror);
  EXPECT_EQ(use.magnify, Filter::nearest);
  EXPECT_EQ(use.minify, Filter::nearest);
  EXPECT_TRUE(use.mipmaps);
}

TEST(GltfMaterial, DefaultsOfASampler) {
  const Model model = load(textured({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}));
  const TextureUse& use = model.scene.materials[0].baseColorTexture;
  EXPECT_EQ(use.wrapU, Wrap::repeat);
  EXPECT_EQ(use.magnify, Filter::linear);
  EXPECT_TRUE(use.mipmaps);
}

TEST(GltfMaterial, ColorAndDataNeedTwoTextures) {
  const json info = {{"index", 0}};
  const Model model =
      load(textured({{"pbrMetallicRoughness", {{"baseColorTexture", info}, {"metallicRoughnessTexture", info}}},
                     {"normalTexture", {{"index", 0}, {"scale", 0.5}}},
                     {"occlusionTexture", {{"index", 0}, {"strength", 0.25}}},
                     {"emissiveTexture", info}}));
  ASSERT_EQ(model.scene.textures.size(), 2u);
  const Material& material = model.scene.materials[0];
  const auto srgb = [&](const TextureUse& use) {
    return model.scene.textures.at(static_cast<std::size_t>(use.texture))->srgb;
  };
  EXPECT_TRUE(srgb(material.baseColorTexture));
  EXPECT_TRUE(srgb(material.emissiveTexture));
  EXPECT_FALSE(srgb(material.metallicRoughnessTexture));
  EXPECT_FALSE(srgb(material.normalTexture));
  EXPECT_FALSE(srgb(material.occlusionTexture));
  EXPECT_EQ(model.scene.textures[0]->texels, model.scene.textures[1]->texels);
  EXPECT_EQ(material.normalScale, 0.5f);
  EXPECT_EQ(material.occlusionStrength, 0.25f);
}

TEST(GltfMaterial, TextureTransformAsTheExtensionsExampleSays) {
  // The example of KHR_texture_transform: only the lower left quadrant of the image, turned by 90 degrees.
  const json transform = {{"KHR_texture_transform",
                           {{"offset", {0, 1}}, {"rotation", 1.57079632679}, {"scale", {0.5, 0.5}}, {"texCoord", 1}}}};
  const Model model =
      load(textured({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"extensions", transform}}}}}}));
  const TextureUse& use = model.scene.materials[0].baseColorTexture;
  EXPECT_EQ(use.uvSet, 1);
  const auto apply = [&](float u, float v) {
    return glm::vec2(glm::dot(use.transform[0], glm::vec3(u, v, 1)), glm::dot(use.transform[1], glm::vec3(u, v, 1)));
  };
  EXPECT_LT(glm::distance(apply(0, 0), glm::vec2(0, 1)), 1e-6f);
  EXPECT_LT(glm::distance(apply(1, 0), glm::vec2(0, 0.5f)), 1e-6f);
  EXPECT_LT(glm::distance(apply(0, 1), glm::vec2(0.5f, 1)), 1e-6f);
}

TEST(GltfMaterial, ExternalAndInlineImages) {
  GltfFile file = textured({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  const TemporaryFolder folder;
  folder.write("a picture.png", smallPng());
  for (const std::string& uri : {std::string("a%20picture.png"), "data:image/png;base64," + base64(smallPng())}) {
    file.root["images"][0] = {{"uri", uri}};
    EXPECT_EQ(loadGltf(folder.write("scene.gltf", file.gltf())).scene.textures.at(0)->width, 2);
  }
}

void expectBadImage(const json& image, const std::string& expected) {
  GltfFile file = textured({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  file.root["images"][0] = image;
  try {
    load(file);
    FAIL() << "loaded " << image;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::badInput);
    EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
  }
}

TEST(GltfMaterial, ImagesThatDoNotDecodeAreNamed) {
  std::string broken = smallPng();
  broken[42] = 2;  // the kind of compressed block and its check
  std::string huge = smallPng();
  huge[16] = 0x7f;
  const auto inline_ = [](const std::string& bytes) { return json{{"uri", "data:image/png;base64," + base64(bytes)}}; };
  expectBadImage({{"uri", "absent.png"}}, "absent.png");
  expectBadImage(inline_(smallPng().substr(0, 45)), "images[0]");
  expectBadImage(inline_(broken), "images[0]");
  expectBadImage(inline_(huge), "at most 16384");
  expectBadImage(inline_("no image at all, but long enough"), "neither PNG nor JPEG");
}

TEST(GltfMaterial, TangentsAreMadeForNormalMaps) {
  const Model model = load(textured({{"normalTexture", {{"index", 0}}}}));
  ASSERT_EQ(model.scene.vertices.size(), 4u);
  for (const Vertex& vertex : model.scene.vertices) {
    EXPECT_LT(glm::distance(glm::vec3(vertex.tangent), glm::vec3(1, 0, 0)), 1e-6f);
    // Green is up: the bitangent points against growing v.
    EXPECT_EQ(vertex.tangent.w, 1);
  }
}

TEST(GltfMaterial, TangentsAreMadeForTheNormalMapOfACoat) {
  const Model model =
      load(textured({{"extensions", {{"KHR_materials_clearcoat", {{"clearcoatNormalTexture", {{"index", 0}}}}}}}}));
  for (const Vertex& vertex : model.scene.vertices)
    EXPECT_LT(glm::distance(glm::vec3(vertex.tangent), glm::vec3(1, 0, 0)), 1e-6f);
}

TEST(GltfMaterial, MirroredTextureCoordinatesSplitVertices) {
  GltfFile file = textured({{"normalTexture", {{"index", 0}}}});
  // Two triangles share an edge; u runs in opposite directions on them.
  const int positions = file.accessor(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0}, "VEC3");
  const int uv = file.accessor(std::vector<float>{0, 1, 1, 1, 1, 0, 0, 1}, "VEC2");
  json& primitive = file.root["meshes"][0]["primitives"][0];
  primitive["attributes"]["POSITION"] = positions;
  primitive["attributes"]["TEXCOORD_0"] = uv;
  primitive["indices"] = file.accessor(std::vector<std::uint16_t>{0, 1, 2, 1, 3, 2}, "SCALAR");
  const Model model = load(file);
  EXPECT_EQ(model.scene.vertices.size(), 6u);
  for (std::size_t t = 0; t < 2; ++t)
    for (const std::uint32_t index : model.scene.triangles[t].vertices) {
      const glm::vec4 tangent = model.scene.vertices[index].tangent;
      EXPECT_LT(glm::distance(glm::vec3(tangent), glm::vec3(t == 0 ? 1 : -1, 0, 0)), 1e-6f);
      EXPECT_EQ(tangent.w, t == 0 ? 1 : -1);
    }
}

TEST(Tangents, AgreeWithThoseOfAnExporter) {
  const auto path = sharedScene("avocado.glb");
  HALFSILVER_REQUIRE_SCENE(path);
  const Model model = loadGltf(path);
  std::vector<Vertex> vertices = model.scene.vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const Triangle& triangle : model.scene.triangles) triangles.push_back(triangle.vertices);
  const TextureUse identity;
  makeTangents(vertices, triangles, 0, identity.transform);
  std::size_t close = 0, sameSign = 0;
  for (std::size_t i = 0; i < model.scene.vertices.size(); ++i) {
    const glm::vec4 theirs = model.scene.vertices[i].tangent, ours = vertices[i].tangent;
    close += glm::dot(glm::vec3(theirs), glm::vec3(ours)) > 0.95f;
    sameSign += theirs.w == ours.w;
  }
  EXPECT_GT(close, model.scene.vertices.size() * 95 / 100);
  EXPECT_GT(sameSign, model.scene.vertices.size() * 98 / 100);
}

}  // namespace
}  // namespace halfsilver::testing
