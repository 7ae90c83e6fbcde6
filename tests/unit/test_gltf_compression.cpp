#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/gtc/quaternion.hpp>

#include "compressed_gltf.h"
#include "gltf_loading.h"

// Extensions that change how geometry is stored: what is encoded here with their libraries loads as what it was.
namespace halfsilver::testing {
namespace {

// The corners of all triangles, sorted: compression reorders.
std::vector<std::array<float, 3>> corners(const Model& model) {
  std::vector<std::array<float, 3>> result;
  for (std::size_t t = 0; t < model.scene.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec3 p = vertex(model, t, k).position;
      result.push_back({std::round(p.x * 1000), std::round(p.y * 1000), std::round(p.z * 1000)});
    }
  std::sort(result.begin(), result.end());
  return result;
}

Model plainSquare() {
  GltfFile file;
  file.primitive({{"POSITION", file.accessor(kSquare, "VEC3")}})["indices"] = file.accessor(kSquareIndices, "SCALAR");
  return load(file);
}

TEST(GltfCompression, DracoMeshesAreWhatWasEncoded) {
  for (const bool sequential : {false, true})
    for (const bool quantized : {false, true}) {
      const Model model = load(dracoFile(dracoSquare(sequential, quantized)));
      EXPECT_EQ(corners(model), corners(plainSquare()));
      EXPECT_TRUE(model.warnings.size() == 2) << "no light and no camera, nothing else";
      for (std::size_t t = 0; t < 2; ++t)
        for (std::size_t k = 0; k < 3; ++k) {
          const Vertex& v = vertex(model, t, k);
          EXPECT_NEAR(v.uv[0].x, v.position.x, 2e-3f);
          EXPECT_NEAR(v.uv[0].y, 1 - v.position.y, 2e-3f);
          EXPECT_EQ(v.color, glm::vec4(1, 0, 0, 1));
        }
    }
}

TEST(GltfCompression, DracoDataThatClaimsTooMuchIsRefused) {
  const std::string data = dracoSquare(true, false);
  EXPECT_EQ(problemOf(dracoFile(data)), "");
  std::string claim = data.substr(0, 11) + "\xff\xff\xff\xff\x07\xff\xff\xff\xff\x07" + data.substr(13);
  EXPECT_NE(problemOf(dracoFile(claim)).find("cannot hold"), std::string::npos);
  for (std::size_t length = 0; length < data.size(); length += 3)
    EXPECT_NE(problemOf(dracoFile(data.substr(0, length))), "") << length;
  GltfFile wrong = dracoFile(data);
  wrong.root["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"] = 9;
  EXPECT_NE(problemOf(wrong).find("no attribute 9"), std::string::npos);
}

Model loadWithFallback(const GltfFile& file) {
  const TemporaryFolder folder;
  return loadGltf(folder.write("scene.gltf", withFallback(file)));
}

TEST(GltfCompression, MeshoptViewsAreWhatWasEncoded) {
  for (const bool triangles : {true, false}) {
    GltfFile file;
    std::vector<unsigned char> data(256);
    data.resize(triangles ? meshopt_encodeIndexBuffer(data.data(), data.size(), kSquareIndices.data(), 6)
                          : meshopt_encodeIndexSequence(data.data(), data.size(), kSquareIndices.data(), 6));
    const int positions = meshoptView(file, encodeVertices(kSquare, 12), 4, 12, "ATTRIBUTES");
    const int indices = meshoptView(file, data, 6, 2, triangles ? "TRIANGLES" : "INDICES");
    file.primitive({{"POSITION", accessorOf(file, positions, 5126, 4, "VEC3")}})["indices"] =
        accessorOf(file, indices, 5123, 6, "SCALAR");
    EXPECT_EQ(corners(loadWithFallback(file)), corners(plainSquare())) << triangles;
  }
}

TEST(GltfCompression, MeshoptFiltersAreUndone) {
  GltfFile file;
  const glm::vec3 normal = glm::normalize(glm::vec3(1, 2, 3));
  std::vector<float> normals;
  for (int i = 0; i < 4; ++i) normals.insert(normals.end(), {normal.x, normal.y, normal.z, 0});
  std::vector<std::int8_t> octahedral(16);
  meshopt_encodeFilterOct(octahedral.data(), 4, 4, 8, normals.data());
  std::vector<std::uint32_t> exponential(12);
  meshopt_encodeFilterExp(exponential.data(), 4, 12, 20, kSquare.data());
  const int positions = meshoptView(file, encodeVertices(exponential, 12), 4, 12, "ATTRIBUTES", "EXPONENTIAL");
  const int directions = meshoptView(file, encodeVertices(octahedral, 4), 4, 4, "ATTRIBUTES", "OCTAHEDRAL");
  file.primitive({{"POSITION", accessorOf(file, positions, 5126, 4, "VEC3")},
                  {"NORMAL", accessorOf(file, directions, 5120, 4, "VEC3", true)}})["indices"] =
      file.accessor(kSquareIndices, "SCALAR");
  const glm::quat quarter = glm::angleAxis(1.5707963f, glm::vec3(0, 0, 1));
  const std::vector<float> turns = {quarter.x, quarter.y, quarter.z, quarter.w, 0, 0, 0, 1};
  std::vector<std::int16_t> quaternions(8);
  meshopt_encodeFilterQuat(quaternions.data(), 2, 8, 16, turns.data());
  const int rotations = meshoptView(file, encodeVertices(quaternions, 8), 2, 8, "ATTRIBUTES", "QUATERNION");
  file.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] =
      accessorOf(file, rotations, 5122, 2, "VEC4", true);
  const Model model = loadWithFallback(file);
  ASSERT_EQ(model.scene.triangles.size(), 4u) << "two instances";
  EXPECT_LT(glm::distance(vertex(model, 2, 0).normal, normal), 0.02f);
  EXPECT_LT(glm::distance(vertex(model, 2, 1).position, glm::vec3(1, 0, 0)), 1e-3f) << "the second is not turned";
  EXPECT_LT(glm::distance(vertex(model, 0, 1).position, glm::vec3(0, 1, 0)), 1e-3f) << "the first by a quarter";
}

TEST(GltfCompression, MeshoptViewsThatCannotBeAreRefused) {
  const auto problem = [](const std::function<void(json&)>& harm) {
    GltfFile file;
    const int positions = meshoptView(file, encodeVertices(kSquare, 12), 4, 12, "ATTRIBUTES");
    file.primitive({{"POSITION", accessorOf(file, positions, 5126, 4, "VEC3")}})["mode"] = 5;
    harm(file.root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]);
    try {
      loadWithFallback(file);
      return std::string();
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(problem([](json&) {}), "");
  const std::vector<std::pair<std::string, std::function<void(json&)>>> harms = {
      {"cannot hold", [](json& view) { view["count"] = 2147483647; }},
      {"byteStride", [](json& view) { view["byteStride"] = 0; }},
      {"byteStride", [](json& view) { view["byteStride"] = 13; }},
      {"byteStride", [](json& view) { view["byteStride"] = 260; }},
      {"unknown mode",
       [](json& view) {
         view["mode"] = "POINTS";
         view["byteStride"] = 4;
       }},
      {"byteStride", [](json& view) { view["mode"] = "TRIANGLES"; }},
      {"the filter", [](json& view) { view["filter"] = "QUATERNION"; }},
      {"filter", [](json& view) { view["filter"] = "SHARPEN"; }},
      {"does not decode", [](json& view) { view["byteLength"] = 3; }},
      {"ends beyond", [](json& view) { view["byteOffset"] = 2000000; }},
      {"ends beyond", [](json& view) { view["byteLength"] = -1; }},
      {"buffers[7]", [](json& view) { view["buffer"] = 7; }}};
  for (const auto& [expected, harm] : harms)
    EXPECT_NE(problem(harm).find(expected), std::string::npos) << expected << ": " << problem(harm);
}

// All attributes of the square as integers, which a node's scale and a texture transform bring back.
TEST(GltfCompression, QuantizedAttributesAreTheirNumbers) {
  for (const bool normalized : {true, false}) {
    GltfFile file;
    const auto scale = [&](int largest) { return normalized ? largest : 1; };
    const auto put = [&](auto largest, std::vector<double> values, const char* kind, int stride) {
      using Value = decltype(largest);
      std::vector<Value> stored;
      const std::size_t width = static_cast<std::size_t>(kind[3] - '0');
      const std::size_t padded = static_cast<std::size_t>(stride) / sizeof(Value);
      for (std::size_t i = 0; i < values.size(); i += width)
        for (std::size_t c = 0; c < padded; ++c)
          stored.push_back(static_cast<Value>(c < width ? values[i + c] * scale(largest) : 0));
      const int view =
          file.view(std::string(reinterpret_cast<const char*>(stored.data()), stored.size() * sizeof(Value)), stride);
      return accessorOf(file, view, componentType<Value>(), values.size() / width, kind, normalized);
    };
    const int positions = put(std::int16_t{32767}, {kSquare.begin(), kSquare.end()}, "VEC3", 8);
    const int normals = put(std::int8_t{127}, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 4);
    const int tangents = put(std::int8_t{127}, {0, 1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1}, "VEC4", 4);
    const int uv = put(std::uint8_t{255}, {0, 1, 1, 1, 1, 0, 0, 0}, "VEC2", 4);
    const int deltas = put(std::int8_t{127}, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 4);
    json& primitive =
        file.primitive({{"POSITION", positions}, {"NORMAL", normals}, {"TANGENT", tangents}, {"TEXCOORD_0", uv}});
    primitive["indices"] = file.accessor(kSquareIndices, "SCALAR");
    primitive["targets"] = json::array({{{"POSITION", deltas}}});
    primitive["material"] = 0;
    file.root["meshes"][0]["weights"] = {0.5};
    file.root["nodes"][0]["scale"] = {2, 2, 2};
    file.add("images", {{"bufferView", file.view(smallPng())}});
    file.add("textures", {{"source", 0}});
    json texture = {{"index", 0}};
    texture["extensions"]["KHR_texture_transform"] = {{"scale", {0.5, 0.25}}, {"offset", {3, 4}}};
    file.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", texture}}}});
    file.root["extensionsUsed"] = file.root["extensionsRequired"] = {"KHR_mesh_quantization", "KHR_texture_transform"};
    const Model model = load(file);
    ASSERT_EQ(model.scene.triangles.size(), 2u);
    EXPECT_LT(glm::distance(vertex(model, 0, 2).position, glm::vec3(2, 2, 1)), 1e-5f) << "corner and morph target";
    EXPECT_LT(glm::distance(vertex(model, 0, 2).normal, glm::vec3(0, 0, 1)), 1e-5f);
    EXPECT_LT(glm::distance(vertex(model, 0, 2).tangent, glm::vec4(0, 1, 0, -1)), 1e-5f);
    EXPECT_LT(glm::distance(vertex(model, 0, 0).uv[0], glm::vec2(0, 1)), 1e-5f);
    const auto& rows = model.scene.materials[0].baseColorTexture.transform;
    EXPECT_FLOAT_EQ(glm::dot(rows[0], glm::vec3(vertex(model, 0, 1).uv[0], 1)), 3.5f);
    EXPECT_FLOAT_EQ(glm::dot(rows[1], glm::vec3(vertex(model, 0, 1).uv[0], 1)), 4.25f);
  }
}

}  // namespace
}  // namespace halfsilver::testing
