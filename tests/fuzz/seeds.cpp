// Writes the inputs that fuzzing starts from: fuzz_seeds FOLDER makes FOLDER/<target>/ for each target.
#include <webp/encode.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb_image_write.h>

#include <halfsilver/io.h>
#include "compressed_gltf.h"
#include "whole_gltf.h"

namespace halfsilver::fuzz {
namespace {

namespace fs = std::filesystem;
using namespace halfsilver::testing;

class Folder {
 public:
  explicit Folder(fs::path path) : path_(std::move(path)) { fs::create_directories(path_); }
  void add(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }

 private:
  fs::path path_;
};

std::string fileBytes(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

GltfFile everyExtension() {
  GltfFile file = everything();
  json& material = file.root["materials"][0];
  const json texture = {{"index", 0},
                        {"extensions", {{"KHR_texture_transform", {{"scale", {2, 2}}, {"rotation", 1}}}}}};
  material["extensions"] = {
      {"KHR_materials_ior", {{"ior", 1.3}}},
      {"KHR_materials_specular", {{"specularFactor", 0.5}, {"specularColorTexture", texture}}},
      {"KHR_materials_emissive_strength", {{"emissiveStrength", 3}}},
      {"KHR_materials_transmission", {{"transmissionFactor", 0.5}, {"transmissionTexture", texture}}},
      {"KHR_materials_volume", {{"thicknessFactor", 0.1}, {"attenuationColor", {1, 0.5, 0}}}},
      {"KHR_materials_dispersion", {{"dispersion", 0.1}}},
      {"KHR_materials_sheen", {{"sheenColorFactor", {1, 0.5, 0}}, {"sheenColorTexture", texture}}},
      {"KHR_materials_anisotropy", {{"anisotropyStrength", 0.5}, {"anisotropyTexture", texture}}},
      {"KHR_materials_clearcoat", {{"clearcoatFactor", 1}, {"clearcoatNormalTexture", texture}}}};
  json& primitive = file.root["meshes"][0]["primitives"][0];
  primitive["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 0}, {"variants", {0}}}};
  file.root["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "Warm"}}};
  file.root["nodes"][4]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", file.accessor(std::vector<float>{0, 0, 0, 1, 2, 3}, "VEC3")}};
  return file;
}

std::string meshoptFile() {
  GltfFile file;
  std::vector<unsigned char> indices(256);
  indices.resize(meshopt_encodeIndexBuffer(indices.data(), indices.size(), kSquareIndices.data(), 6));
  const int positions = meshoptView(file, encodeVertices(kSquare, 12), 4, 12, "ATTRIBUTES");
  const int triangles = meshoptView(file, indices, 6, 2, "TRIANGLES");
  file.primitive({{"POSITION", accessorOf(file, positions, 5126, 4, "VEC3")}})["indices"] =
      accessorOf(file, triangles, 5123, 6, "SCALAR");
  return withFallback(file);
}

// How many of the shared cases there were.
std::size_t makeScenes(const Folder& folder) {
  folder.add("everything.glb", everything().glb());
  folder.add("everything.gltf", everything().gltf());
  folder.add("extensions.glb", everyExtension().glb());
  folder.add("draco.glb", dracoFile(dracoSquare(false, true)).glb());
  folder.add("draco_sequential.glb", dracoFile(dracoSquare(true, false)).glb());
  folder.add("meshopt.gltf", meshoptFile());
  const fs::path cases = fs::path(HALFSILVER_SOURCE_DIR) / ".." / "shared" / "cases";
  std::error_code absent;
  std::size_t found = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(cases, absent)) {
    const std::string kind = entry.path().extension().string();
    if (kind != ".gltf" && kind != ".glb") continue;
    folder.add(entry.path().filename().string(), fileBytes(entry.path()));
    ++found;
  }
  return found;
}

void makeSettings(const Folder& folder) {
  for (const PresetFile& file : presetFiles()) folder.add(std::string(file.name) + ".toml", std::string(file.text));
  std::vector<std::string> names;
  for (const SettingInfo& info : describe({})) names.push_back(info.name);
  folder.add("every.toml", settingsText({}, names));
  folder.add("kinds.toml",
             "select.mode = 'all' # a comment\nvoxels = { resolution = 0x20 }\n[image]\nexposure = -1.5e0\n"
             "a = \"\"\"\nlong\"\"\"\nb = [1, 2.5, [true], {c = 1979-05-27T07:32:00Z}]\n[[list]]\n[|name]\n");
}

// As accessors.cpp reads them: a view of three positions, sparse or not.
void makeAccessors(const Folder& folder) {
  const auto word = [](int value) {
    return std::string{static_cast<char>(value & 255), static_cast<char>(value >> 8)};
  };
  const auto byte = [](int value) { return std::string(1, static_cast<char>(value)); };
  constexpr int kFloat = 7, kShort = 4;  // from 5119 on
  for (const bool sparse : {false, true}) {
    std::string text = byte(0) + word(0) + word(36) + byte(0);  // positions
    text += byte(0) + word(36) + word(4) + byte(0);             // sparse indices
    text += byte(0) + word(40) + word(24) + byte(0);            // sparse values
    text += byte(1) + word(0) + word(3) + byte(kFloat) + byte(3) + byte(0) + byte(sparse);
    if (sparse) text += word(2) + byte(2) + byte(kShort) + byte(3) + word(0) + word(0);
    text += std::string(36, '\x3f') + word(0) + word(2) + std::string(24, '\x40');
    folder.add(sparse ? "sparse" : "plain", text);
  }
}

void append(void* context, void* data, int size) {
  static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

std::string text(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void makeImages(const Folder& folder) {
  constexpr int kSide = 12;
  std::vector<std::uint8_t> texels;
  std::vector<float> light;
  for (int i = 0; i < kSide * kSide; ++i) {
    texels.insert(texels.end(), {static_cast<std::uint8_t>(i), 200, static_cast<std::uint8_t>(3 * i), 255});
    light.insert(light.end(), {static_cast<float>(i), 0.5f, 1000});
  }
  folder.add("a.png", text(encodePng(kSide, kSide, texels)));
  folder.add("small.png", smallPng());
  folder.add("a.exr", text(encodeExr({kSide, kSide, {"R", "G", "B"}, light}, 2.0)));
  std::string jpeg, hdr;
  stbi_write_jpg_to_func(append, &jpeg, kSide, kSide, 4, texels.data(), 80);
  stbi_write_hdr_to_func(append, &hdr, kSide, kSide, 3, light.data());
  folder.add("a.jpg", jpeg);
  folder.add("a.hdr", hdr);
  for (const bool lossless : {false, true}) {
    std::uint8_t* encoded = nullptr;
    const std::size_t size = lossless ? WebPEncodeLosslessRGBA(texels.data(), kSide, kSide, 4 * kSide, &encoded)
                                      : WebPEncodeRGBA(texels.data(), kSide, kSide, 4 * kSide, 50, &encoded);
    folder.add(lossless ? "lossless.webp" : "lossy.webp", {reinterpret_cast<const char*>(encoded), size});
    WebPFree(encoded);
  }
}

}  // namespace
}  // namespace halfsilver::fuzz

int main(int count, char** arguments) {
  using namespace halfsilver::fuzz;
  if (count != 2) {
    std::fprintf(stderr, "usage: fuzz_seeds FOLDER\n");
    return 2;
  }
  const fs::path folder = arguments[1];
  if (makeScenes(Folder(folder / "gltf")) == 0) std::printf("../shared/cases is absent: seeds go without it\n");
  makeSettings(Folder(folder / "settings"));
  makeAccessors(Folder(folder / "accessors"));
  makeImages(Folder(folder / "images"));
}
