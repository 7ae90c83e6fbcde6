#include <webp/encode.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <halfsilver/pose.h>
#include "gltf_loading.h"
#include "io/gltf_uri.h"

// Extensions of images, materials and nodes.
namespace halfsilver::testing {
namespace {

// The square with an image in a texture's extension; `fallback` is the texture's own.
Model imaged(const std::string& extension, const std::string& image, bool fallback) {
  GltfFile file;
  json& primitive = file.primitive({{"POSITION", file.accessor(kSquare, "VEC3")}});
  primitive["mode"] = 6;
  primitive["material"] = 0;
  file.add("images", {{"bufferView", file.view(image)}});
  file.add("images", {{"bufferView", file.view(smallPng())}});
  json texture;
  texture["extensions"][extension]["source"] = 0;
  if (fallback) texture["source"] = 1;
  file.add("textures", texture);
  file.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  file.root["extensionsUsed"] = {extension};
  return load(file);
}

TEST(GltfFormats, WebpTexturesAreWhatWasEncoded) {
  std::vector<std::uint8_t> texels;
  for (int i = 0; i < 12; ++i)
    texels.insert(texels.end(),
                  {200, static_cast<std::uint8_t>(20 * i), 40, static_cast<std::uint8_t>(i < 6 ? 255 : 128)});
  std::uint8_t* encoded = nullptr;
  const std::size_t size = WebPEncodeLosslessRGBA(texels.data(), 4, 3, 16, &encoded);
  ASSERT_GT(size, 0u);
  const std::string image(reinterpret_cast<const char*>(encoded), size);
  WebPFree(encoded);
  for (const bool fallback : {false, true}) {
    const Model model = imaged("EXT_texture_webp", image, fallback);
    ASSERT_EQ(model.scene.textures.size(), 1u);
    EXPECT_EQ(model.scene.textures[0]->width, 4);
    EXPECT_EQ(model.scene.textures[0]->height, 3);
    EXPECT_EQ(model.scene.textures[0]->texels, texels);
  }
  for (std::size_t length = 1; length < image.size(); length += 3)
    EXPECT_THROW(imaged("EXT_texture_webp", image.substr(0, length), false), Error) << length;
}

// 16 x 16 texels of 200, 30, 40; the lower half has alpha 128.
constexpr const char* kAvif =
    "AAAAHGZ0eXBhdmlmAAAAAGF2aWZtaWYxbWlhZgAAAZhtZXRhAAAAAAAAACFoZGxyAAAAAAAAAABwaWN0AAAAAAAAAAAAAAAAAAAA"
    "AA5waXRtAAAAAAABAAAANGlsb2MAAAAAREAAAgACAAAAAAG8AAEAAAAAAAAAFwABAAAAAAHTAAEAAAAAAAAAIAAAADhpaW5mAAAA"
    "AAACAAAAFWluZmUCAAAAAAEAAGF2MDEAAAAAFWluZmUCAAAAAAIAAGF2MDEAAAAA12lwcnAAAACxaXBjbwAAABNjb2xybmNseAAC"
    "AAIABoAAAAAMYXYxQ4EAHAAAAAAUaXNwZQAAAAAAAAAQAAAAEAAAAA5waXhpAAAAAAEIAAAAOGF1eEMAAAAAdXJuOm1wZWc6bXBl"
    "Z0I6Y2ljcDpzeXN0ZW1zOmF1eGlsaWFyeTphbHBoYQAAAAAMYXYxQ4EADAAAAAAUaXNwZQAAAAAAAAAQAAAAEAAAABBwaXhpAAAA"
    "AAMICAgAAAAeaXBtYQAAAAAAAAACAAEEgYYHiAACBIIDhIUAAAAaaXJlZgAAAAAAAAAOYXV4bAACAAEAAQAAAD9tZGF0EgAKBRgM"
    "/9hUMgxEYAAAULBmkWudaYASAAoJGAz/2CBAQNCAMhERgAAAQABXtthY9+PZwXtPfg==";

TEST(GltfFormats, AvifTexturesNeedOpenImageIo) {
  const std::string image = textOf(gltf::readUri(std::string("data:;base64,") + kAvif, {}));
  if (HALFSILVER_OPENIMAGEIO) {
    for (const bool fallback : {false, true}) {
      const Model model = imaged("EXT_texture_avif", image, fallback);
      ASSERT_EQ(model.scene.textures.size(), 1u);
      const Texture& texture = *model.scene.textures[0];
      ASSERT_EQ(texture.width, 16);
      const std::uint8_t expected[] = {200, 30, 40, 255};
      for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(texture.texels[c], expected[c], 4);
      EXPECT_NEAR(texture.texels[4 * 16 * 12], 200, 4) << "not multiplied by its alpha";
      EXPECT_NEAR(texture.texels[4 * 16 * 12 + 3], 128, 2);
    }
    return;
  }
  EXPECT_EQ(imaged("EXT_texture_avif", image, true).scene.textures[0]->width, 2) << "the texture's own image";
  try {
    imaged("EXT_texture_avif", image, false);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("only OpenImageIO"), std::string::npos);
  }
}

TEST(GltfFormats, AnImageThatItsBytesCannotHoldIsRefused) {
  std::string png = smallPng();
  png.replace(16, 8, std::string("\0\0\x40\0\0\0\x40\0", 8));
  for (const std::string& image : {png, std::string("\xff\xd8\xff\xc0\0\x11\x08\x3f\xff\x3f\xff\x03", 12)}) try {
      imaged("EXT_texture_webp", image, false);
      FAIL();
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("bytes"), std::string::npos) << error.what();
    }
}

TEST(GltfFormats, AVariantChoosesMaterialsByName) {
  GltfFile file;
  json& primitive = file.triangle();
  for (const char* name : {"plain", "red", "blue"}) file.add("materials", {{"name", name}});
  primitive["material"] = 0;
  primitive["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 1}, {"variants", {0, 2}}},
                                                                   {{"material", 2}, {"variants", {1}}}};
  file.triangle()["material"] = 0;
  file.root["extensions"]["KHR_materials_variants"]["variants"] = {
      {{"name", "Warm"}}, {{"name", "Cold"}}, {{"name", "Hot"}}};
  const auto materials = [&](const std::string& variant) {
    const Model model = load(file, {.variant = variant});
    EXPECT_EQ(model.variants, (std::vector<std::string>{"Warm", "Cold", "Hot"}));
    return model.scene.materials[model.scene.triangles.at(0).material].name + " " +
           model.scene.materials[model.scene.triangles.at(1).material].name;
  };
  EXPECT_EQ(materials(""), "plain plain");
  EXPECT_EQ(materials("Warm"), "red plain");
  EXPECT_EQ(materials("Cold"), "blue plain");
  EXPECT_EQ(materials("2"), "red plain") << "by index";
  try {
    materials("cold");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_NE(std::string(error.what()).find("unknown variant 'cold'; known are 0 'Warm', 1 'Cold', 2 'Hot'"),
              std::string::npos);
  }
}

TEST(GltfFormats, InstancesArePlacedByTheirAttributesBelowTheirNode) {
  GltfFile file;
  file.triangle();
  json& attributes = file.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  const int places = file.accessor(std::vector<float>{0, 0, 0, 1, 2, 3}, "VEC3");
  attributes = {{"TRANSLATION", places},
                {"SCALE", file.accessor(std::vector<float>{1, 1, 1, 2, 2, 2}, "VEC3")},
                {"ROTATION", file.accessor(std::vector<std::int8_t>{0, 0, 0, 127, 0, 0, 127, 0}, "VEC4", true)},
                {"_ID", places}};
  file.root["nodes"][0]["translation"] = {10, 0, 0};
  const Model model = load(file);
  ASSERT_EQ(model.scene.triangles.size(), 2u);
  EXPECT_LT(glm::distance(vertex(model, 0, 1).position + glm::vec3(model.scene.origin), glm::vec3(11, 0, 0)), 1e-5f);
  EXPECT_LT(glm::distance(vertex(model, 1, 1).position + glm::vec3(model.scene.origin), glm::vec3(9, 2, 3)), 1e-5f);
  file.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] =
      file.accessor(std::vector<float>{1, 1, 1}, "VEC3");
  EXPECT_NE(problemOf(file).find("different lengths"), std::string::npos);
}

TEST(GltfFormats, TheInstancesOfAMovingNodeMoveWithItAndMorph) {
  GltfFile file;
  json& primitive = file.triangle();
  primitive["targets"] =
      json::array({{{"POSITION", file.accessor(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")}}});
  file.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      file.accessor(std::vector<float>{0, 0, 0, 5, 0, 0}, "VEC3");
  const int times = file.accessor(std::vector<float>{0, 1}, "SCALAR");
  file.add("animations", {{"samplers",
                           {{{"input", times}, {"output", file.accessor(std::vector<float>{0, 0, 0, 0, 2, 0}, "VEC3")}},
                            {{"input", times}, {"output", file.accessor(std::vector<float>{0, 1}, "SCALAR")}}}},
                          {"channels",
                           {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}},
                            {{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
  Model model = load(file);
  const Playing playing{0, 1};
  pose(model, std::span(&playing, 1));
  EXPECT_LT(glm::distance(vertex(model, 0, 0).position, glm::vec3(0, 2, 1)), 1e-5f);
  EXPECT_LT(glm::distance(vertex(model, 1, 0).position, glm::vec3(5, 2, 1)), 1e-5f);
}

}  // namespace
}  // namespace halfsilver::testing
