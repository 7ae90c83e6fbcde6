#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include "gltf_loading.h"

// Geometry and hierarchy of glTF files with known answers.
namespace halfsilver::testing {
namespace {

glm::vec3 normalOf(const Model& model, std::size_t triangle) {
  const glm::vec3 a = corner(model, triangle, 0);
  return glm::normalize(glm::cross(corner(model, triangle, 1) - a, corner(model, triangle, 2) - a));
}

const std::vector<float> kStrip = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};

TEST(Gltf, OneTriangleInEveryContainer) {
  GltfFile file;
  file.triangle();
  const TemporaryFolder folder;
  folder.write("the data.bin", file.buffer + "a file may be longer than its buffer");
  for (const auto& path :
       {folder.write("a.glb", file.glb()), folder.write("b.gltf", file.gltf()),
        folder.write("c.gltf", file.gltf("the%20data.bin")), folder.write("glb.with.another.name", file.glb())}) {
    const Model model = loadGltf(path);
    ASSERT_EQ(model.scene.triangles.size(), 1u) << path;
    EXPECT_TRUE(near(corner(model, 0, 1), {1, 0, 0}));
    EXPECT_TRUE(near(vertex(model, 0, 2).normal, {0, 0, 1})) << "a missing normal is computed";
    EXPECT_EQ(model.scene.materials.size(), 1u) << "the default material";
    EXPECT_EQ(model.scene.materials[0].metallic, 1.0f);
    EXPECT_TRUE(model.rig.instances.empty()) << "nothing moves";
    ASSERT_EQ(model.parts.size(), 1u);
    EXPECT_EQ(model.parts[0].triangleCount, 1u);
  }
}

TEST(Gltf, StripAndFanWindLikeTriangles) {
  for (const int mode : {5, 6}) {
    GltfFile file;
    // A strip 0 1 2 3, or a fan about the first corner; both front faces look along +z.
    const std::vector<float> fan = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    file.primitive({{"POSITION", file.accessor(mode == 5 ? kStrip : fan, "VEC3")}})["mode"] = mode;
    const Model model = load(file);
    ASSERT_EQ(model.scene.triangles.size(), 2u) << mode;
    for (std::size_t t = 0; t < 2; ++t) EXPECT_TRUE(near(normalOf(model, t), {0, 0, 1})) << mode;
  }
}

TEST(Gltf, PointsAndLinesAreSkippedWithAWarning) {
  GltfFile file;
  file.triangle();
  file.triangle()["mode"] = 1;
  const Model model = load(file);
  EXPECT_EQ(model.scene.triangles.size(), 1u);
  EXPECT_TRUE(warns(model, "points and lines"));
}

template <class T>
void checkIndices() {
  GltfFile file;
  file.primitive({{"POSITION", file.accessor(kStrip, "VEC3")}})["indices"] =
      file.accessor(std::vector<T>{2, 0, 3}, "SCALAR");
  const Model model = load(file);
  ASSERT_EQ(model.scene.triangles.size(), 1u);
  EXPECT_TRUE(near(corner(model, 0, 0), {0, 1, 0}));
  EXPECT_TRUE(near(corner(model, 0, 2), {1, 1, 0}));
}

TEST(Gltf, IndicesOfEveryWidth) {
  checkIndices<std::uint8_t>();
  checkIndices<std::uint16_t>();
  checkIndices<std::uint32_t>();
}

TEST(Gltf, InterleavedAndSparse) {
  GltfFile file;
  std::string interleaved;
  for (int i = 0; i < 3; ++i) {
    const float vertex[6] = {i == 1 ? 1.0f : 0.0f, i == 2 ? 1.0f : 0.0f, 0, 0, 0, -2};
    interleaved.append(reinterpret_cast<const char*>(vertex), sizeof(vertex));
  }
  const int view = file.view(interleaved, 24);
  const int indices = file.view(std::vector<std::uint16_t>{2});
  const int values = file.view(std::vector<float>{0, 5, 0});
  const int positions = file.add("accessors", {{"bufferView", view},
                                               {"componentType", 5126},
                                               {"count", 3},
                                               {"type", "VEC3"},
                                               {"sparse",
                                                {{"count", 1},
                                                 {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                                 {"values", {{"bufferView", values}}}}}});
  const int normals = file.add(
      "accessors", {{"bufferView", view}, {"byteOffset", 12}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
  file.primitive({{"POSITION", positions}, {"NORMAL", normals}});
  const Model model = load(file);
  EXPECT_TRUE(near(corner(model, 0, 1), {1, 0, 0}));
  EXPECT_TRUE(near(corner(model, 0, 2), {0, 5, 0}));
  EXPECT_TRUE(near(vertex(model, 0, 0).normal, {0, 0, -1})) << "normals become unit length";
}

TEST(Gltf, SparseWithoutAViewStartsFromZeros) {
  GltfFile file;
  const int indices = file.view(std::vector<std::uint8_t>{1, 2});
  const int values = file.view(std::vector<float>{1, 0, 0, 0, 1, 0});
  file.primitive({{"POSITION", file.add("accessors", {{"componentType", 5126},
                                                      {"count", 3},
                                                      {"type", "VEC3"},
                                                      {"sparse",
                                                       {{"count", 2},
                                                        {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                                        {"values", {{"bufferView", values}}}}}})}});
  const Model model = load(file);
  EXPECT_TRUE(near(corner(model, 0, 0), {0, 0, 0}));
  EXPECT_TRUE(near(corner(model, 0, 2), {0, 1, 0}));
}

// One attribute value in every type that can hold it.
template <class T>
void checkColor(T full, T half, float expectedHalf, const char* type) {
  GltfFile file;
  json& primitive = file.triangle();
  const std::string name(type);
  std::vector<T> colors;
  for (int i = 0; i < 3; ++i) {
    colors.insert(colors.end(), {full, half, T(0)});
    if (name == "VEC4") colors.push_back(half);
  }
  primitive["attributes"]["COLOR_0"] = file.accessor(colors, type, !std::is_same_v<T, float>);
  const Model model = load(file);
  const glm::vec4 color = vertex(model, 0, 1).color;
  EXPECT_NEAR(color.r, 1, 1e-6) << type;
  EXPECT_NEAR(color.g, expectedHalf, 1e-6) << type;
  EXPECT_NEAR(color.b, 0, 1e-6) << type;
  EXPECT_NEAR(color.a, name == "VEC4" ? expectedHalf : 1, 1e-6) << type;
}

TEST(Gltf, VertexColorsOfEveryType) {
  for (const char* type : {"VEC3", "VEC4"}) {
    checkColor<float>(1, 0.5f, 0.5f, type);
    checkColor<std::uint8_t>(255, 51, 0.2f, type);
    checkColor<std::uint16_t>(65535, 13107, 0.2f, type);
  }
}

template <class T>
void checkPositions(bool normalized, double scale) {
  GltfFile file;
  file.primitive({{"POSITION", file.accessor(std::vector<T>{0, 0, 0, 100, 0, 0, 0, 50, 0}, "VEC3", normalized)}});
  const Model model = load(file);
  EXPECT_TRUE(near(corner(model, 0, 1), {static_cast<float>(100 * scale), 0, 0}));
  EXPECT_TRUE(near(corner(model, 0, 2), {0, static_cast<float>(50 * scale), 0}));
}

TEST(Gltf, QuantizedPositions) {
  checkPositions<std::int8_t>(true, 1 / 127.0);
  checkPositions<std::int8_t>(false, 1);
  checkPositions<std::uint8_t>(true, 1 / 255.0);
  checkPositions<std::int16_t>(true, 1 / 32767.0);
  checkPositions<std::uint16_t>(true, 1 / 65535.0);
  checkPositions<std::uint16_t>(false, 1);
}

TEST(Gltf, TextureCoordinatesOfBothSets) {
  GltfFile file;
  json& primitive = file.triangle();
  primitive["attributes"]["TEXCOORD_0"] = file.accessor(std::vector<std::uint8_t>{0, 0, 255, 0, 0, 51}, "VEC2", true);
  primitive["attributes"]["TEXCOORD_1"] = file.accessor(std::vector<float>{0, 0, -3, 0, 0, 7}, "VEC2");
  const Model model = load(file);
  EXPECT_NEAR(vertex(model, 0, 2).uv[0].y, 0.2f, 1e-6);
  EXPECT_EQ(vertex(model, 0, 1).uv[1].x, -3);
}

TEST(Gltf, TransformsMultiplyFromTheRoot) {
  GltfFile file;
  file.triangle();
  const double half = std::sqrt(0.5);
  file.root["nodes"][0]["translation"] = {1, 0, 0};
  file.root["nodes"][0]["scale"] = {2, 1, 1};
  file.add("nodes", {{"rotation", {0, 0, half, half}}, {"children", {0}}});  // a quarter turn about z
  file.add("nodes", {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 20, 30, 1}}, {"children", {1}}});
  const Model model = load(file);
  // (1,0,0) -> scaled and moved (3,0,0) -> rotated (0,3,0) -> moved.
  EXPECT_TRUE(near(corner(model, 0, 1), {10, 23, 30}));
  EXPECT_TRUE(near(corner(model, 0, 0), {10, 21, 30}));
  EXPECT_TRUE(near(vertex(model, 0, 0).normal, {0, 0, 1}));
}

TEST(Gltf, NormalsFollowTheInverseTranspose) {
  GltfFile file;
  // A slope in x and y; squeezing y turns its normal toward y.
  file.primitive({{"POSITION", file.accessor(std::vector<float>{1, 0, 0, 0, 1, 0, 1, 0, 1}, "VEC3")},
                  {"NORMAL", file.accessor(std::vector<float>{1, 1, 0, 1, 1, 0, 1, 1, 0}, "VEC3")}});
  file.root["nodes"][0]["scale"] = {1, 0.5, 1};
  const Model model = load(file);
  EXPECT_TRUE(near(vertex(model, 0, 0).normal, glm::normalize(glm::vec3(1, 2, 0))));
}

TEST(Gltf, MirroringFlipsTheWindingAndKeepsNormalsOutside) {
  GltfFile file;
  json& primitive = file.triangle();
  primitive["attributes"]["NORMAL"] = file.accessor(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  primitive["attributes"]["TANGENT"] = file.accessor(std::vector<float>{1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
  file.root["nodes"][0]["scale"] = {-1, 1, 1};
  const Model model = load(file);
  EXPECT_TRUE(near(normalOf(model, 0), {0, 0, 1}));
  EXPECT_TRUE(near(vertex(model, 0, 0).normal, {0, 0, 1}));
  EXPECT_TRUE(near(glm::vec3(vertex(model, 0, 0).tangent), {-1, 0, 0}));
  EXPECT_EQ(vertex(model, 0, 0).tangent.w, -1) << "the bitangent stays +y";
}

TEST(Gltf, FlattenedMatricesKeepTheirNormals) {
  GltfFile file;
  json& primitive = file.triangle();
  primitive["attributes"]["NORMAL"] = file.accessor(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  file.root["nodes"][0]["scale"] = {1, 1, 0};
  EXPECT_TRUE(near(vertex(load(file), 0, 0).normal, {0, 0, 1}));
}

TEST(Gltf, EachNodeGetsItsOwnCopy) {
  GltfFile file;
  file.triangle();
  file.root["nodes"][0]["name"] = "left";
  file.root["meshes"][0]["name"] = "shape";
  file.add("nodes", {{"mesh", 0}, {"translation", {5, 0, 0}}});
  const Model model = load(file);
  ASSERT_EQ(model.scene.triangles.size(), 2u);
  EXPECT_TRUE(near(corner(model, 1, 0), {5, 0, 0}));
  ASSERT_EQ(model.parts.size(), 2u);
  EXPECT_EQ(model.parts[0].node, "left");
  EXPECT_EQ(model.parts[0].mesh, "shape");
  EXPECT_EQ(model.parts[1].node, "node 1");
  EXPECT_EQ(model.parts[1].firstTriangle, 1u);
}

TEST(Gltf, OnlyTheDefaultSceneCounts) {
  GltfFile file;
  file.triangle();
  file.triangle();
  file.root["nodes"][1]["translation"] = {0, 7, 0};
  file.root["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}, {"name", "second"}}};
  file.root["scene"] = 1;
  const Model model = load(file);
  ASSERT_EQ(model.scene.triangles.size(), 1u);
  EXPECT_TRUE(near(corner(model, 0, 0), {0, 7, 0}));
  EXPECT_EQ(model.scene.name, "second");
}

TEST(Gltf, FarFromZeroKeepsItsPrecision) {
  GltfFile file;
  file.triangle();
  file.root["nodes"][0]["translation"] = {6378137.25, 0, -4.5e6};
  const Model model = load(file);
  EXPECT_NE(model.scene.origin, glm::dvec3(0));
  const glm::dvec3 world = model.scene.origin + glm::dvec3(corner(model, 0, 1));
  EXPECT_EQ(world, glm::dvec3(6378138.25, 0, -4.5e6));
  EXPECT_LT(glm::length(corner(model, 0, 0)), 4) << "close to the origin";
}

TEST(Gltf, NearZeroStaysThere) {
  GltfFile file;
  file.triangle();
  file.root["nodes"][0]["translation"] = {3, 0, 0};
  EXPECT_EQ(load(file).scene.origin, glm::dvec3(0));
}

TEST(Gltf, DegenerateAndNonFiniteTrianglesAreDroppedAndCounted) {
  const float nan = std::nanf("");
  GltfFile file;
  file.primitive(
      {{"POSITION",
        file.accessor(std::vector<float>{0, 0, 0,   1, 0, 0,        0, 1, 0,  // kept
                                         0, 0, 0,   0, 0, 0,        0, 1, 0,  // two equal corners
                                         0, 0, nan, 1, 0, 0,        0, 1, 0,  // not a number
                                         0, 0, 0,   1, 1, 1,        3, 3, 3,  // on a line
                                         0, 0, 0,   0, 0, INFINITY, 0, 1, 0, 0, 0, 2, 1, 0, 2, 0, 1, 2},  // kept
                      "VEC3")}});
  const Model model = load(file);
  EXPECT_EQ(model.scene.triangles.size(), 2u);
  EXPECT_EQ(model.dropped.degenerate, 2u);
  EXPECT_EQ(model.dropped.nonFinite, 2u);
  EXPECT_TRUE(near(corner(model, 1, 0), {0, 0, 2})) << "numbers continue without a gap";
  for (const Vertex& v : model.scene.vertices) EXPECT_TRUE(std::isfinite(v.position.z));
}

TEST(Gltf, ScenesWithoutLightOrCameraGetBoth) {
  GltfFile file;
  file.triangle();
  const Model model = load(file);
  ASSERT_EQ(model.scene.lights.size(), 1u);
  EXPECT_EQ(model.scene.lights[0].type, LightType::directional);
  ASSERT_EQ(model.scene.cameras.size(), 1u);
  EXPECT_TRUE(warns(model, "no lights"));
  EXPECT_TRUE(warns(model, "no camera"));
}

TEST(Gltf, CamerasStandWhereTheirNodesStand) {
  GltfFile file;
  file.triangle();
  const double half = std::sqrt(0.5);
  file.root["cameras"] = {
      {{"type", "perspective"}, {"name", "main"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1.5}, {"zfar", 10}, {"znear", 0.1}}}}};
  file.add("nodes", {{"camera", 1}});
  file.add("nodes",
           {{"camera", 0}, {"translation", {4, 5, 6}}, {"rotation", {0, half, 0, half}}, {"scale", {3, 3, 3}}});
  const Model model = load(file);
  ASSERT_EQ(model.scene.cameras.size(), 2u) << "in the order of the file's cameras";
  const Camera& camera = model.scene.cameras[0];
  EXPECT_EQ(camera.name, "main");
  EXPECT_NEAR(camera.verticalFov, 0.7f, 1e-6);
  EXPECT_NEAR(camera.nearPlane, 0.1f, 1e-6);
  EXPECT_TRUE(near(camera.eye, {4, 5, 6}));
  EXPECT_TRUE(near(glm::normalize(camera.target - camera.eye), {-1, 0, 0})) << "-z rotated by 90 degrees about y";
  EXPECT_EQ(camera.parallelHeight, 0.0f);
  EXPECT_FLOAT_EQ(model.scene.cameras[1].parallelHeight, 3);
  EXPECT_FLOAT_EQ(model.scene.cameras[1].farPlane, 10);
}

TEST(Gltf, PunctualLights) {
  GltfFile file;
  file.triangle();
  const double half = std::sqrt(0.5);
  file.root["extensionsUsed"] = {"KHR_lights_punctual"};
  file.root["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "directional"}, {"intensity", 3}},
      {{"type", "point"}, {"color", {1, 0.5, 0}}, {"intensity", 40}, {"range", 9}},
      {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.4}}}}};
  const json one = {{"KHR_lights_punctual", {{"light", 0}}}}, two = {{"KHR_lights_punctual", {{"light", 1}}}},
             three = {{"KHR_lights_punctual", {{"light", 2}}}};
  file.add("nodes", {{"extensions", one}, {"rotation", {-half, 0, 0, half}}});
  file.add("nodes", {{"extensions", two}, {"translation", {1, 2, 3}}});
  file.add("nodes", {{"extensions", three}});
  const Model model = load(file);
  ASSERT_EQ(model.scene.lights.size(), 3u);
  EXPECT_TRUE(near(model.scene.lights[0].direction, {0, -1, 0}));
  EXPECT_EQ(model.scene.lights[0].intensity, 3);
  EXPECT_EQ(model.scene.lights[1].type, LightType::point);
  EXPECT_TRUE(near(model.scene.lights[1].position, {1, 2, 3}));
  EXPECT_TRUE(near(model.scene.lights[1].color, {1, 0.5, 0}));
  EXPECT_EQ(model.scene.lights[1].range, 9);
  EXPECT_EQ(model.scene.lights[2].type, LightType::spot);
  EXPECT_NEAR(model.scene.lights[2].outerConeAngle, 0.4, 1e-6);
  EXPECT_FALSE(warns(model, "no lights"));
  EXPECT_FALSE(warns(model, "extension"));
}

TEST(Gltf, UnknownExtensions) {
  GltfFile file;
  file.triangle();
  file.root["extensionsUsed"] = {"ACME_teapots"};
  EXPECT_TRUE(warns(load(file), "ACME_teapots"));
  file.root["extensionsRequired"] = {"ACME_teapots"};
  try {
    load(file);
    FAIL() << "a required extension was ignored";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::badInput);
    EXPECT_NE(std::string(error.what()).find("ACME_teapots"), std::string::npos) << error.what();
  }
}

TEST(FrameAll, EveryCornerIsInView) {
  Bounds bounds;
  bounds.add({-3, 10, 0.5f});
  bounds.add({50, 11, 7});
  const Camera camera = frameAll(bounds);
  const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
  const float slope = std::tan(camera.verticalFov / 2);
  float widest = 0;
  for (int i = 0; i < 8; ++i) {
    const glm::vec3 p(i & 1 ? bounds.high.x : bounds.low.x, i & 2 ? bounds.high.y : bounds.low.y,
                      i & 4 ? bounds.high.z : bounds.low.z);
    const glm::vec3 seen = p - camera.eye;
    const float depth = glm::dot(seen, forward);
    ASSERT_GT(depth, 0);
    widest = std::max({widest, std::abs(glm::dot(seen, up)) / (depth * slope),
                       std::abs(glm::dot(seen, right)) / (depth * slope * 4 / 3)});
  }
  EXPECT_LT(widest, 1.0f);
  EXPECT_GT(widest, 0.8f) << "and fills the picture";
  EXPECT_GT(camera.eye.y, bounds.high.y) << "from above";
}

}  // namespace
}  // namespace halfsilver::testing
