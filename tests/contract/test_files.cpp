#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include <halfsilver/io.h>
#include "program.h"
#include "shared_scenes.h"

// Files as they come from the field, through the programs.
namespace halfsilver {
namespace {

// Of ../shared/cases, beside the shared scenes.
std::filesystem::path sharedCase(const std::string& name) {
  return testing::sharedScene("").parent_path().parent_path() / "cases" / name;
}

#define REQUIRE_CASES() \
  if (!std::filesystem::exists(sharedCase("b10_uri_04.gltf"))) GTEST_SKIP() << "shared cases are absent"

Image layersOf(const std::filesystem::path& scene, const std::string& options = "") {
  const TemporaryFolder folder;
  const ProgramResult result = runProgramIn(
      folder, "render " + scene.string() + " --preset deferred --size 320x180 -o a.png --layers l.exr " + options);
  EXPECT_EQ(result.exitCode, 0) << scene << ": " << result.err;
  return result.exitCode == 0 ? readImage(folder / "l.exr").image : Image{};
}

// Mean height in meters of what is seen straight on from along z, and how many pixels it covers.
struct Seen {
  double row = 0;
  std::size_t pixels = 0;
};

Seen seenIn(const Image& layers) {
  Seen seen;
  for (int y = 0; y < layers.height; ++y)
    for (int x = 0; x < layers.width; ++x)
      if (valueAt(layers, "depth.Z", x, y) > 0) {
        seen.row += y + 0.5;
        ++seen.pixels;
      }
  if (seen.pixels) seen.row /= static_cast<double>(seen.pixels);
  return seen;
}

TEST(Files, UrisAreReadAsTheStandardSaysIt) {
  REQUIRE_CASES();
  for (const char* name : {"b10_uri_04.gltf", "b10_buffer_0.gltf"}) {
    const Image layers = layersOf(sharedCase(name));
    ASSERT_GT(layers.width, 0);
    EXPECT_NEAR(valueAt(layers, "depth.Z", 160, 90), 3.0f, 1e-4f) << name;
    const float middle = valueAt(layers, "R", 160, 90) + valueAt(layers, "G", 160, 90) + valueAt(layers, "B", 160, 90);
    EXPECT_GT(middle, 0.01f) << name << " shows its image";
  }
}

TEST(Files, ChunksOfUnknownTypesAndEmptyOnesLoad) {
  REQUIRE_CASES();
  for (const char* name : {"b18_unknown_chunk_no_bin.glb", "b18_empty_bin.glb"}) {
    const Seen seen = seenIn(layersOf(sharedCase(name)));
    EXPECT_GT(seen.pixels, 1000u) << name;
  }
}

TEST(Files, AllJointsOfAVertexMoveIt) {
  REQUIRE_CASES();
  const TemporaryFolder folder;
  for (const char* posing : {"--set scene.posing=cpu --time 0", "--set scene.posing=gpu --time 0", ""}) {
    const Image layers = layersOf(sharedCase("b31_eight_joints.gltf"),
                                  std::string("--fov 45 --eye 0,0.7,10 --target 0,0.7,0 ") + posing);
    const Seen seen = seenIn(layers);
    EXPECT_GT(seen.pixels, 50u) << posing;
    EXPECT_NEAR(seen.row, 90, 1) << "in the middle of a picture around y = 0.7: " << posing;
  }
}

// A triangle in a file of its own, with a buffer at a URI.
std::string sceneWith(const std::string& uri, const nlohmann::json& more = nlohmann::json::object()) {
  nlohmann::json root = {{"asset", {{"version", "2.0"}}},
                         {"buffers", {{{"byteLength", 36}, {"uri", uri}}}},
                         {"bufferViews", {{{"buffer", 0}, {"byteLength", 36}}}},
                         {"accessors", {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}}}},
                         {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
                         {"nodes", {{{"mesh", 0}}}}};
  root.update(more, true);
  return root.dump();
}

void write(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::string triangleBytes() {
  const float values[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  return {reinterpret_cast<const char*>(values), sizeof(values)};
}

TEST(Files, WhatIsOutsideTheFolderIsRefusedWithALine) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "scene");
  write(folder / "outside.bin", triangleBytes());
  write(folder / "scene/inside.bin", triangleBytes());
  for (const char* uri : {"inside.bin", "./sub/../inside.bin", "in%73ide.bin"}) {
    write(folder / "scene/a.gltf", sceneWith(uri));
    EXPECT_EQ(runProgramIn(folder, "info scene/a.gltf").exitCode, 0) << uri;
  }
  for (const char* uri : {"../outside.bin", "inside.bin%00", "%2e%2e/outside.bin", "/etc/hostname", "absent.bin"}) {
    write(folder / "scene/a.gltf", sceneWith(uri));
    const ProgramResult result = runProgramIn(folder, "info scene/a.gltf");
    EXPECT_EQ(result.exitCode, 3) << uri;
    EXPECT_NE(result.err.find(uri), std::string::npos) << "the line names it: " << result.err;
  }
}

TEST(Files, VariantsAreListedAndAnUnknownOneIsRefusedWithTheList) {
  const TemporaryFolder folder;
  write(folder / "buffer.bin", triangleBytes());
  const nlohmann::json variants = {
      {"materials", {{{"name", "plain"}}, {{"name", "red"}}}},
      {"meshes",
       {{{"primitives",
          {{{"attributes", {{"POSITION", 0}}},
            {"material", 0},
            {"extensions", {{"KHR_materials_variants", {{"mappings", {{{"material", 1}, {"variants", {1}}}}}}}}}}}}}}},
      {"extensions", {{"KHR_materials_variants", {{"variants", {{{"name", "Day"}}, {{"name", "Night"}}}}}}}}};
  write(folder / "a.gltf", sceneWith("buffer.bin", variants));
  const ProgramResult listed = runProgramIn(folder, "info a.gltf");
  EXPECT_EQ(listed.exitCode, 0) << listed.err;
  EXPECT_NE(listed.out.find("1 'Night'"), std::string::npos) << listed.out;
  const ProgramResult json = runProgramIn(folder, "info a.gltf --json --variant Night");
  ASSERT_EQ(json.exitCode, 0) << json.err;
  const nlohmann::json info = nlohmann::json::parse(json.out);
  EXPECT_EQ(info["variants"], (nlohmann::json{"Day", "Night"}));
  EXPECT_EQ(info["parts"][0]["material"], 1);
  for (const char* command : {"info a.gltf --variant Noon", "render a.gltf -o a.png --variant Noon"}) {
    const ProgramResult unknown = runProgramIn(folder, command);
    EXPECT_EQ(unknown.exitCode, 2) << command;
    EXPECT_NE(unknown.err.find("known are 0 'Day', 1 'Night'"), std::string::npos) << unknown.err;
  }
  EXPECT_EQ(runProgramIn(folder, "info builtin:sphere --variant Day").exitCode, 2);
}

// The pixels of what moves in one frame of a clip.
double columnOf(const Image& layers) {
  double sum = 0;
  std::size_t count = 0;
  for (int y = 0; y < layers.height; ++y)
    for (int x = 0; x < layers.width; ++x)
      if (valueAt(layers, "depth.Z", x, y) > 0) {
        sum += x + 0.5;
        ++count;
      }
  EXPECT_GT(count, 20u);
  return sum / static_cast<double>(count);
}

TEST(Files, BeyondItsEndAnimationLoopsOrHolds) {
  REQUIRE_CASES();
  const auto scene = sharedCase("b05_slide_0.4.gltf");
  const double early = columnOf(layersOf(scene, "--time 0.1")), last = columnOf(layersOf(scene, "--time 0.4"));
  ASSERT_GT(last, early + 40);
  EXPECT_NEAR(columnOf(layersOf(scene, "--time 3600.1")), early, 0.01) << "after an hour, which is 9000 loops";
  EXPECT_NEAR(columnOf(layersOf(scene, "--time 3600.1 --loop")), early, 0.01);
  EXPECT_NEAR(columnOf(layersOf(scene, "--time 3600.1 --hold")), last, 0.01);
  EXPECT_NEAR(columnOf(layersOf(scene, "--time 0.1 --hold")), early, 0.01);
}

}  // namespace
}  // namespace halfsilver
