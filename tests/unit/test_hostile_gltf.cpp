#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include <halfsilver/pose.h>
#include "whole_gltf.h"

// Files that are wrong in every conceivable way. A load either succeeds, with a model in which every index is valid, or
// throws Error (badInput) with one line; run under the address and undefined-behavior sanitizers.
namespace halfsilver::testing {
namespace {

void expectConsistent(const Model& model) {
  const Scene& scene = model.scene;
  ASSERT_FALSE(scene.triangles.empty());
  ASSERT_FALSE(scene.cameras.empty());
  for (const Triangle& triangle : scene.triangles) {
    ASSERT_LT(triangle.material, scene.materials.size());
    for (const std::uint32_t index : triangle.vertices) ASSERT_LT(index, scene.vertices.size());
  }
  for (const Vertex& vertex : scene.vertices) {
    for (int c = 0; c < 3; ++c) ASSERT_TRUE(std::isfinite(vertex.position[c]));
    ASSERT_NEAR(glm::length(vertex.normal), 1, 1e-3);
    ASSERT_NEAR(glm::length(glm::vec3(vertex.tangent)), 1, 1e-3);
    for (int c = 0; c < 4; ++c) ASSERT_TRUE(std::isfinite(vertex.color[c]));
  }
  for (const Material& material : scene.materials) {
    ASSERT_LT(material.baseColorTexture.texture, static_cast<int>(scene.textures.size()));
    ASSERT_LT(material.normalTexture.texture, static_cast<int>(scene.textures.size()));
  }
  for (std::size_t n = 0; n < model.rig.nodes.size(); ++n) ASSERT_LT(model.rig.nodes[n].parent, static_cast<int>(n));
  ASSERT_EQ(model.rig.lightNodes.size(), scene.lights.size());
  ASSERT_EQ(model.rig.cameraNodes.size(), scene.cameras.size());
}

// An animation of valid numbers may still leave the range of floats.
void play(Model& model) {
  for (int animation = 0; animation < static_cast<int>(model.rig.animations.size()); ++animation) {
    try {
      const Playing playing{animation, 0.4};
      pose(model, std::span(&playing, 1));
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::badInput) << error.what();
    }
  }
}

// The message, or nothing if the file loads.
std::string load(const TemporaryFolder& folder, const std::string& bytes) {
  const auto path = folder.write("scene.gltf", bytes);
  try {
    Model model = loadGltf(path);
    expectConsistent(model);
    play(model);
    return "";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::badInput) << error.what();
    const std::string message = error.what();
    EXPECT_EQ(message.find(path.string()), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
}

TEST(HostileGltf, TheUnharmedFileLoads) {
  const TemporaryFolder folder;
  EXPECT_EQ(load(folder, everything().glb()), "");
  EXPECT_EQ(load(folder, everything().gltf()), "");
}

struct Harm {
  const char* name;
  std::function<void(GltfFile&)> apply;
  const char* expected;  // a part of the message
};

TEST(HostileGltf, EveryKnownHarmGivesItsLine) {
  const auto position = [](GltfFile& file) -> json& {
    return file.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
  };
  const auto setFloat = [](GltfFile& file, std::size_t index, float value) {
    std::memcpy(file.buffer.data() + 4 * index, &value, 4);
  };
  const std::vector<Harm> harms = {
      {"accessor", [&](GltfFile& f) { position(f) = 999; }, "refers to accessors[999]"},
      {"negative accessor", [&](GltfFile& f) { position(f) = -5; }, "out of range"},
      {"text for a number", [&](GltfFile& f) { position(f) = "0"; }, "not a whole number"},
      {"view", [](GltfFile& f) { f.root["accessors"][0]["bufferView"] = 99; }, "bufferViews[99]"},
      {"buffer", [](GltfFile& f) { f.root["bufferViews"][0]["buffer"] = 7; }, "buffers[7]"},
      {"view too long", [](GltfFile& f) { f.root["bufferViews"][0]["byteLength"] = 1 << 30; }, "ends beyond"},
      {"view far away", [](GltfFile& f) { f.root["bufferViews"][0]["byteOffset"] = 4294967295u; }, "ends beyond"},
      {"view around the end", [](GltfFile& f) { f.root["bufferViews"][0]["byteOffset"] = 1LL << 52; }, "ends beyond"},
      {"offset", [](GltfFile& f) { f.root["accessors"][0]["byteOffset"] = 1LL << 40; }, "ends beyond"},
      {"count", [](GltfFile& f) { f.root["accessors"][0]["count"] = 4000000000u; }, "ends beyond"},
      {"count beyond 64 bits", [](GltfFile& f) { f.root["accessors"][0]["count"] = 1e30; }, "not a whole number"},
      {"no elements", [](GltfFile& f) { f.root["accessors"][0]["count"] = 0; }, "no elements"},
      {"zeros without end",
       [](GltfFile& f) {
         f.root["accessors"][0].erase("bufferView");
         f.root["accessors"][0]["count"] = 4000000000u;
       },
       "without data"},
      {"stride", [](GltfFile& f) { f.root["bufferViews"][0]["byteStride"] = 4; }, "byteStride"},
      {"odd stride", [](GltfFile& f) { f.root["bufferViews"][0]["byteStride"] = 253; }, "byteStride"},
      {"component type", [](GltfFile& f) { f.root["accessors"][0]["componentType"] = 5124; }, "component type"},
      {"element type", [](GltfFile& f) { f.root["accessors"][0]["type"] = "VEC2"; }, "wrong type"},
      {"sparse index", [](GltfFile& f) { f.buffer[48] = 77; }, "sparse index"},
      {"sparse count", [](GltfFile& f) { f.root["accessors"][0]["sparse"]["count"] = 5; }, "sparse"},
      {"sparse view", [](GltfFile& f) { f.root["accessors"][0]["sparse"]["values"]["bufferView"] = 55; },
       "bufferViews[55]"},
      {"vertex index",
       [](GltfFile& f) {
         const int index = f.accessor(std::vector<std::uint16_t>{0, 1, 60000}, "SCALAR");
         f.root["meshes"][0]["primitives"][0]["indices"] = index;
       },
       "the index 60000"},
      {"float indices", [](GltfFile& f) { f.root["meshes"][0]["primitives"][0]["indices"] = 0; }, "wrong"},
      {"attribute lengths", [](GltfFile& f) { f.root["accessors"][1]["count"] = 3; }, "3 elements for 4 vertices"},
      {"material", [](GltfFile& f) { f.root["meshes"][0]["primitives"][0]["material"] = 5; }, "materials[5]"},
      {"mode", [](GltfFile& f) { f.root["meshes"][0]["primitives"][0]["mode"] = 9; }, "mode 9"},
      {"no attributes", [](GltfFile& f) { f.root["meshes"][0]["primitives"][0].erase("attributes"); }, "no attributes"},
      {"texture", [](GltfFile& f) { f.root["materials"][0]["normalTexture"]["index"] = 4; }, "textures[4]"},
      {"image", [](GltfFile& f) { f.root["textures"][0]["source"] = 4; }, "images[4]"},
      {"sampler", [](GltfFile& f) { f.root["textures"][0]["sampler"] = 4; }, "samplers[4]"},
      {"image view", [](GltfFile& f) { f.root["bufferViews"].back()["byteOffset"] = 1 << 30; }, "ends beyond"},
      {"mesh", [](GltfFile& f) { f.root["nodes"][0]["mesh"] = 3; }, "meshes[3]"},
      {"skin", [](GltfFile& f) { f.root["nodes"][0]["skin"] = 3; }, "skins[3]"},
      {"camera", [](GltfFile& f) { f.root["nodes"][3]["camera"] = 3; }, "cameras[3]"},
      {"light", [](GltfFile& f) { f.root["nodes"][3]["extensions"]["KHR_lights_punctual"]["light"] = 3; }, "lights[3]"},
      {"joint",
       [](GltfFile& f) {
         f.root["skins"][0]["joints"] = {1, 88};
       },
       "nodes[88]"},
      {"too few joints", [](GltfFile& f) { f.root["skins"][0]["joints"] = {1}; }, "joint 1"},
      {"no joints", [](GltfFile& f) { f.root["skins"][0]["joints"] = json::array(); }, "no joints"},
      {"bind matrices",
       [](GltfFile& f) {
         f.root["skins"][0]["joints"] = {1, 2, 1};
       },
       "fewer inverse bind"},
      {"child",
       [](GltfFile& f) {
         f.root["nodes"][1]["children"] = {2, 99};
       },
       "nodes[99]"},
      {"two parents", [](GltfFile& f) { f.root["nodes"][0]["children"] = {3}; }, "two parents"},
      {"a child twice",
       [](GltfFile& f) {
         f.root["nodes"][1]["children"] = {2, 2, 3};
       },
       "two parents"},
      {"cycle",
       [](GltfFile& f) {
         f.root["nodes"][4]["children"] = {1};
         f.root["scenes"][0]["nodes"] = {0};
       },
       "its own ancestor"},
      {"own child",
       [](GltfFile& f) {
         f.root["nodes"][0]["children"] = {0};
         f.root["scenes"][0]["nodes"] = {1};
       },
       "its own ancestor"},
      {"scene root inside",
       [](GltfFile& f) {
         f.root["scenes"][0]["nodes"] = {0, 2};
       },
       "not a root"},
      {"scene node", [](GltfFile& f) { f.root["scenes"][0]["nodes"] = {44}; }, "nodes[44]"},
      {"scene", [](GltfFile& f) { f.root["scene"] = 8; }, "scenes[8]"},
      {"empty scene", [](GltfFile& f) { f.root["scenes"][0]["nodes"] = json::array(); }, "no triangles"},
      {"short matrix",
       [](GltfFile& f) {
         f.root["nodes"][4]["matrix"] = {1, 0, 0};
       },
       "matrix has 3"},
      {"projective matrix", [](GltfFile& f) { f.root["nodes"][4]["matrix"][3] = 1; }, "not affine"},
      {"long translation",
       [](GltfFile& f) {
         f.root["nodes"][2]["translation"] = {1, 2, 3, 4};
       },
       "translation has 4"},
      {"huge scale", [](GltfFile& f) { f.root["nodes"][4]["matrix"][0] = 1e300; }, "beyond 1e30"},
      {"far apart", [](GltfFile& f) { f.root["nodes"][4]["matrix"][12] = 1e25; }, "m across"},
      {"huge position", [&](GltfFile& f) { setFloat(f, 6, 3e38f); }, ""},
      {"animated node", [](GltfFile& f) { f.root["animations"][0]["channels"][0]["target"]["node"] = 66; },
       "nodes[66]"},
      {"animation sampler", [](GltfFile& f) { f.root["animations"][0]["channels"][0]["sampler"] = 9; }, "samplers[9]"},
      {"animation input", [](GltfFile& f) { f.root["animations"][0]["samplers"][0]["input"] = 600; }, "accessors[600]"},
      {"animation output", [](GltfFile& f) { f.root["animations"][0]["samplers"][0]["output"] = 1; }, "wrong type"},
      {"cubic without tangents",
       [](GltfFile& f) { f.root["animations"][0]["samplers"][0]["interpolation"] = "CUBICSPLINE"; }, "6 numbers for 6"},
      {"times that are not numbers",
       [](GltfFile& f) {
         f.root["animations"][0]["samplers"][0]["input"] = f.accessor(std::vector<float>{0, std::nanf("")}, "SCALAR");
       },
       "not finite"},
      {"morph target", [](GltfFile& f) { f.root["meshes"][0]["primitives"][0]["targets"][0]["POSITION"] = 321; },
       "accessors[321]"},
      {"version 1", [](GltfFile& f) { f.root["asset"]["version"] = "1.0"; }, "needs glTF 1.0"},
      {"no asset", [](GltfFile& f) { f.root.erase("asset"); }, "asset.version"},
      {"nodes that are no list", [](GltfFile& f) { f.root["nodes"] = 5; }, "not a list"},
      {"a node that is a number", [](GltfFile& f) { f.root["nodes"][2] = 5; }, "not an object"},
      {"light type", [](GltfFile& f) { f.root["extensions"]["KHR_lights_punctual"]["lights"][0]["type"] = "laser"; },
       "laser"},
      {"required extension", [](GltfFile& f) { f.root["extensionsRequired"] = {"EXT_unheard_of"}; }, "unheard"},
  };
  const TemporaryFolder folder;
  for (const Harm& harm : harms) {
    GltfFile file = everything();
    harm.apply(file);
    for (const std::string& bytes : {file.glb(), file.gltf()}) {
      const std::string message = load(folder, bytes);
      EXPECT_NE(message.find(harm.expected), std::string::npos) << harm.name << " gave: " << message;
    }
  }
}

TEST(HostileGltf, NonFiniteNumbersInBuffersNeverGetThrough) {
  const TemporaryFolder folder;
  const GltfFile file = everything();
  for (std::size_t at = 0; at + 4 <= file.buffer.size(); at += 4)
    for (const float value : {std::nanf(""), INFINITY, -INFINITY, 3e38f, 1e-44f}) {
      GltfFile harmed = file;
      std::memcpy(harmed.buffer.data() + at, &value, 4);
      load(folder, harmed.glb());
    }
}

TEST(HostileGltf, EveryTruncation) {
  const TemporaryFolder folder;
  const std::string binary = everything().glb(), text = everything().gltf();
  for (std::size_t length = 0; length < binary.size(); length += length < 64 ? 1 : 37)
    EXPECT_NE(load(folder, binary.substr(0, length)), "") << length;
  for (std::size_t length = 0; length < text.size(); length += length < 64 ? 1 : 53)
    EXPECT_NE(load(folder, text.substr(0, length)), "") << length;
}

TEST(HostileGltf, FilesThatAreNoScene) {
  const TemporaryFolder folder;
  for (const std::string& bytes :
       {std::string("hello"), std::string("{}"), std::string("[]"), std::string("{\"asset\":[]}"),
        std::string(99, '\0'), std::string("glTF"), smallPng(), std::string("\xff\xfe{\0", 4),
        std::string("{\"asset\":{\"version\":\"2.0\"}}")})
    EXPECT_NE(load(folder, bytes), "");
  EXPECT_THROW(loadGltf(folder.path() / "absent.glb"), Error);
  EXPECT_THROW(loadGltf(folder.path()), Error) << "a folder";
}

TEST(HostileGltf, DeepNesting) {
  const TemporaryFolder folder;
  const std::string open = "{\"asset\":{\"version\":\"2.0\",\"extras\":";
  EXPECT_NE(load(folder, open + std::string(1000000, '[')).find("nested"), std::string::npos);
  EXPECT_NE(load(folder, open + std::string(1000000, '[') + std::string(1000000, ']') + "}}").find("nested"),
            std::string::npos);
}

TEST(HostileGltf, LongChainsOfNodes) {
  GltfFile file;
  file.triangle();
  for (int i = 1; i < 20000; ++i) file.add("nodes", {{"children", {i - 1}}, {"translation", {0, 0, 0.001}}});
  const TemporaryFolder folder;
  EXPECT_EQ(load(folder, file.glb()), "");
}

TEST(HostileGltf, SmallFilesCannotExpandWithoutLimit) {
  const TemporaryFolder folder;
  GltfFile copies;  // many nodes place one large mesh
  copies.primitive({{"POSITION", copies.accessor(std::vector<float>(300000, 1), "VEC3")}});
  for (int i = 0; i < 20000; ++i) copies.add("nodes", {{"mesh", 0}});
  EXPECT_NE(load(folder, copies.glb()).find("more than"), std::string::npos);

  GltfFile targets;  // many targets use one accessor
  targets.triangle();
  const int large = targets.accessor(std::vector<float>(300000, 1), "VEC3");
  targets.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = large;
  for (int i = 0; i < 20000; ++i)
    targets.root["meshes"][0]["primitives"][0]["targets"].push_back({{"POSITION", large}});
  EXPECT_NE(load(folder, targets.glb()).find("expands"), std::string::npos);

  GltfFile buffers;  // many buffers refer to the binary chunk
  buffers.triangle();
  std::string bytes = buffers.glb();
  buffers.root["buffers"] = json::array({{{"byteLength", 36}}, {{"byteLength", 36}}});
  const std::string buffer = std::exchange(buffers.buffer, "");
  EXPECT_NE(load(folder, buffers.glb()).find("no data: buffers[0]"), std::string::npos);
}

// Leaves of a JSON value.
void collect(json& value, std::vector<json*>& leaves) {
  if (value.is_structured())
    for (auto& element : value) collect(element, leaves);
  leaves.push_back(&value);
}

TEST(HostileGltf, RandomJson) {
  std::mt19937 random(20260101);
  const TemporaryFolder folder;
  const GltfFile file = everything();
  const std::vector<json> replacements = {
      -1,         0,          1,           2,      5,    7,    255,    65535, 2147483647, 2147483648u,
      4294967296, -1e300,     1e300,       1e-300, 0.5,  "",   "VEC3", true,  nullptr,    json::array(),
      {1, 2, 3},  {{"a", 1}}, {-1, 99999}, 5121,   5126, 5123, 4,      6,     "SCALAR",   "MAT4"};
  int loaded = 0, refused = 0;
  for (int round = 0; round < 3000; ++round) {
    GltfFile harmed = file;
    for (unsigned change = 0; change <= random() % 3; ++change) {
      std::vector<json*> leaves;
      collect(harmed.root, leaves);
      json& target = *leaves[random() % leaves.size()];
      if (random() % 4 == 0 && target.is_array() && !target.empty())
        target.erase(random() % target.size());
      else if (random() % 4 == 0 && target.is_object() && !target.empty())
        target.erase(std::next(target.begin(), static_cast<std::ptrdiff_t>(random() % target.size())));
      else
        target = replacements[random() % replacements.size()];
    }
    const std::string bytes = round % 2 && harmed.root.is_object() ? harmed.glb() : harmed.root.dump();
    (load(folder, bytes).empty() ? loaded : refused) += 1;
    if (HasFatalFailure()) FAIL() << harmed.root.dump();
  }
  EXPECT_GT(loaded, 50);
  EXPECT_GT(refused, 500);
}

TEST(HostileGltf, RandomBytes) {
  std::mt19937 random(7);
  const TemporaryFolder folder;
  const std::string whole = everything().glb();
  int loaded = 0, refused = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string bytes = whole;
    const unsigned changes = 1 + random() % 8;
    // Half of the rounds only damage the binary chunk, which the JSON check does not see.
    const std::size_t from = round % 2 ? bytes.size() - everything().buffer.size() : 0;
    for (unsigned change = 0; change < changes; ++change)
      bytes[from + random() % (bytes.size() - from)] = static_cast<char>(random());
    (load(folder, bytes).empty() ? loaded : refused) += 1;
    if (HasFatalFailure()) FAIL() << "round " << round;
  }
  EXPECT_GT(loaded, 50);
  EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace halfsilver::testing
