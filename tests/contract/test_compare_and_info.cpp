#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "program.h"

namespace halfsilver {
namespace {

void writeFile(const std::filesystem::path& file, const std::vector<std::byte>& bytes) {
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
}

// A pattern, moved to the right by `shift` pixels.
std::vector<std::byte> pattern(int shift) {
  std::vector<std::uint8_t> pixels;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      for (const int value : {((x - shift) / 8 + y / 8) % 2 ? 220 : 30, (x - shift) & 255, y * 4, 255})
        pixels.push_back(static_cast<std::uint8_t>(value));
  return encodePng(64, 64, pixels);
}

nlohmann::json compareJson(const TemporaryFolder& folder, const std::string& arguments) {
  const ProgramResult result = runProgramIn(folder, "compare --json " + arguments);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  return nlohmann::json::parse(result.out, nullptr, false);
}

TEST(Info, DeviceListsWhatEachOffersAndWhatIsNeeded) {
  const TemporaryFolder folder;
  const ProgramResult text = runProgramIn(folder, "info --device");
  EXPECT_EQ(text.exitCode, 0) << text.err;
  EXPECT_NE(text.out.find("storage blocks in compute shaders"), std::string::npos) << text.out;
  const ProgramResult result = runProgramIn(folder, "info --device --json");
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const nlohmann::json devices = nlohmann::json::parse(result.out)["devices"];
  ASSERT_FALSE(devices.empty());
  std::size_t usable = 0;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    EXPECT_EQ(devices[i]["number"], i);
    if (devices[i].contains("refused")) continue;
    ++usable;
    EXPECT_NE(devices[i]["version"].get<std::string>().find("4."), std::string::npos);
    EXPECT_GT(devices[i]["limits"].size(), 5u);
    for (const auto& limit : devices[i]["limits"]) EXPECT_GE(limit["offered"], limit.value("least", 0)) << limit;
    // By its number and by a part of its renderer's name, whatever the case.
    std::string name = devices[i]["renderer"];
    name = name.substr(0, name.find(' '));
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::toupper(c); });
    for (const std::string& chosen : {std::to_string(i), name}) {
      const ProgramResult drawn = runProgramIn(folder, kQuickSphere + "-o a.png --stats s.json --device " + chosen);
      EXPECT_EQ(drawn.exitCode, 0) << drawn.err;
      EXPECT_EQ(readJson(folder.path() / "s.json")["device"]["renderer"], devices[i]["renderer"]);
    }
  }
  EXPECT_GT(usable, 0u);
}

TEST(Info, AnUnknownDeviceIsToldWithThoseThatThereAre) {
  const TemporaryFolder folder;
  for (const char* device : {"99", "nosuch"}) {
    const ProgramResult result = runProgramIn(folder, kQuickSphere + std::string("-o a.png --device ") + device);
    EXPECT_EQ(result.exitCode, 4);
    EXPECT_NE(result.err.find(std::string("no device '") + device), std::string::npos) << result.err;
    EXPECT_TRUE(filesIn(folder).empty());
  }
  EXPECT_EQ(runProgramIn(folder, "info").exitCode, 2);
  EXPECT_EQ(runProgramIn(folder, "info --device builtin:sphere").exitCode, 2);
}

TEST(CompareCommand, IdenticalAndShiftedImages) {
  const TemporaryFolder folder;
  writeFile(folder / "a.png", pattern(0));
  writeFile(folder / "b.png", pattern(3));
  const auto same = compareJson(folder, "a.png a.png");
  EXPECT_EQ(same["rmse"], 0.0);
  EXPECT_EQ(same["max_error"], 0.0);
  EXPECT_TRUE(same["psnr_db"].is_null());
  EXPECT_FALSE(same.contains("hit_error"));
  const auto shifted = compareJson(folder, "b.png a.png");
  EXPECT_GT(shifted["rmse"], 0.1);
  EXPECT_NEAR(shifted["psnr_db"].get<double>(), -20 * std::log10(shifted["rmse"].get<double>()), 1e-6);
  EXPECT_GT(shifted["max_error"], 0.5);
  EXPECT_LE(shifted["max_error"], 1.0);
  if (HALFSILVER_OPENIMAGEIO) {
    EXPECT_EQ(same["yee_failures"], 0);
    EXPECT_EQ(same["yee_fail_fraction"], 0.0);
    EXPECT_GT(shifted["yee_failures"], 100);
    EXPECT_GT(shifted["yee_fail_fraction"], 0.02);
  } else {
    EXPECT_TRUE(same["yee_failures"].is_null());
  }
  const ProgramResult text = runProgramIn(folder, "compare a.png a.png");
  EXPECT_EQ(text.exitCode, 0);
  EXPECT_NE(text.out.find("psnr_db             inf"), std::string::npos) << text.out;
}

TEST(CompareCommand, DifferentSizesAre3) {
  const TemporaryFolder folder;
  writeFile(folder / "a.png", pattern(0));
  writeFile(folder / "b.png", encodePng(2, 2, std::vector<std::uint8_t>(16, 9)));
  const ProgramResult result = runProgramIn(folder, "compare a.png b.png --json");
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_NE(result.err.find("64x64"), std::string::npos) << result.err;
  EXPECT_EQ(result.out, "");
}

TEST(CompareCommand, LayersOfTwoMethods) {
  const TemporaryFolder folder;
  const std::string common = kQuickSphere + "--stats s.json -o a.png ";
  ASSERT_EQ(runProgramIn(folder, common + "--layers a.exr").exitCode, 0);
  ASSERT_EQ(runProgramIn(folder, common + "--layers b.exr --set select.fraction=0.5").exitCode, 0);
  const auto same = compareJson(folder, "a.exr a.exr");
  for (const char* key : {"hit_error", "false_miss", "false_hit", "wrong_id", "selected_mismatch"})
    EXPECT_EQ(same[key], 0.0) << key;
  // Half of the pixels are not traced: these are the only differences, and every hit among them is missed.
  const auto half = compareJson(folder, "b.exr a.exr");
  EXPECT_NEAR(half["selected_mismatch"].get<double>(), 0.5, 0.1);
  EXPECT_GT(half["false_miss"], 0.1);
  EXPECT_EQ(half["false_hit"], 0.0);
  EXPECT_EQ(half["hit_error"], half["false_miss"]);
}

// All rays of a method beside those of the reference, by kind.
TEST(CompareCommand, RaysByKind) {
  const TemporaryFolder folder;
  const auto layersOf = [&](const std::string& file, const std::string& arguments) {
    const ProgramResult result =
        runProgramIn(folder, "render builtin:glass --size 48x27 --set trace.tally=true -o a.png --stats s.json " +
                                 arguments + " --layers " + file);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return readJson(folder / "s.json")["rays"];
  };
  const std::map<std::string, std::vector<std::string>> kinds = {
      {"reflection", {"reflection"}},
      {"whitted", {"reflection", "refraction", "shadow"}},
      {"occlusion", {"occlusion"}},
      {"path", {"scattered", "shadow"}},
  };
  for (const auto& [effect, expected] : kinds) {
    const std::string with = "--set trace.effect=" + effect + " --set effect.samples=2 ";
    layersOf("reference.exr", with + "--set trace.method=exact");
    const auto rays = layersOf("own.exr", with + "--set trace.method=identity");
    const auto own = compareJson(folder, "own.exr reference.exr");
    for (const std::string& kind : expected) {
      ASSERT_TRUE(own["kinds"].contains(kind)) << effect << ": " << own;
      EXPECT_GT(own["kinds"][kind]["rays"], 100) << effect;
      EXPECT_EQ(own["kinds"][kind]["rays"], rays[kind]) << effect;
    }
    for (const auto& [kind, figures] : own["kinds"].items())
      for (const char* wrong : {"unmatched", "false_occlusion", "false_visibility", "wrong_distance"})
        EXPECT_EQ(figures[wrong], 0) << effect << ' ' << kind << ' ' << wrong;
  }
  // What the camera does not see is not there.
  const std::string occlusion = "--preset occlusion --set trace.method=";
  layersOf("reference.exr", occlusion + "exact");
  layersOf("screen.exr", occlusion + "screen-space");
  const auto screen = compareJson(folder, "screen.exr reference.exr")["kinds"]["occlusion"];
  EXPECT_GT(screen["false_visibility"], screen["rays"].get<int>() / 100);
  EXPECT_EQ(screen["unmatched"], 0);
  const ProgramResult text = runProgramIn(folder, "compare screen.exr reference.exr");
  EXPECT_NE(text.out.find("rays: occlusion"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("false_visibility " + screen["false_visibility"].dump()), std::string::npos) << text.out;
  // Files without these counts are compared as ever.
  ASSERT_EQ(runProgramIn(folder, kQuickSphere + "-o a.png --layers plain.exr").exitCode, 0);
  EXPECT_FALSE(compareJson(folder, "plain.exr plain.exr").contains("kinds"));
}

TEST(InfoCommand, SaysWhatTheSceneHolds) {
  const TemporaryFolder folder;
  writeWall(folder, 10);
  const ProgramResult result = runProgramIn(folder, "info wall.gltf --json");
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["triangles"], 1);
  EXPECT_EQ(json["vertices"], 3);
  ASSERT_EQ(json["materials"].size(), 1u);
  EXPECT_EQ(json["materials"][0]["name"], "paint");
  EXPECT_EQ(json["materials"][0]["double_sided"], true);
  EXPECT_EQ(json["materials"][0]["alpha_mode"], "opaque");
  // glTF's default is a metal: its reflectance is the luminance of its color.
  EXPECT_NEAR(json["materials"][0]["reflectivity"].get<double>(), 0.2126 * 0.8 + 0.7152 * 0.2 + 0.0722 * 0.1, 1e-6);
  EXPECT_EQ(json["bounds"]["low"], nlohmann::json::array({-90.0, -100.0, 0.0}));
  EXPECT_EQ(json["bounds"]["high"], nlohmann::json::array({110.0, 100.0, 0.0}));
  EXPECT_NEAR(json["diagonal"].get<double>(), std::hypot(200, 200), 1e-3);
  ASSERT_EQ(json["cameras"].size(), 1u);
  EXPECT_EQ(json["cameras"][0]["name"], "near");
  EXPECT_EQ(json["cameras"][0]["eye"], nlohmann::json::array({10.0, 0.0, 5.0}));
  ASSERT_EQ(json["parts"].size(), 1u);
  const auto& part = json["parts"][0];
  EXPECT_EQ(part["node"], "wall");
  EXPECT_EQ(part["primitive"], 0);
  EXPECT_EQ(part["first_triangle"], 0);
  EXPECT_EQ(part["triangles"], 1);
  EXPECT_EQ(part["material"], 0);
  EXPECT_EQ(json["dropped"]["degenerate"], 0);
  EXPECT_EQ(json["dropped"]["non_finite"], 0);
  EXPECT_TRUE(json["animations"].empty());
  EXPECT_TRUE(json["warnings"].is_array());
  const ProgramResult text = runProgramIn(folder, "info wall.gltf");
  EXPECT_EQ(text.exitCode, 0);
  EXPECT_NE(text.out.find("paint"), std::string::npos) << text.out;
}

TEST(InfoCommand, KnowsTheBuiltInScenes) {
  const TemporaryFolder folder;
  const ProgramResult result = runProgramIn(folder, "info builtin:sphere --json");
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_GT(json["triangles"], 1000);
  EXPECT_GT(json["cameras"].size(), 0u);
}

TEST(InfoCommand, TellsOfAreaLights) {
  const TemporaryFolder folder;
  const ProgramResult result = runProgramIn(folder, "info builtin:cornell --json --light sphere:0,1,0:0.25:1,2,3");
  EXPECT_EQ(result.exitCode, 0) << result.err;
  const nlohmann::json lights = nlohmann::json::parse(result.out)["lights"];
  ASSERT_EQ(lights.size(), 2u);
  EXPECT_EQ(lights[0]["type"], "rectangle");
  EXPECT_EQ(lights[0]["width"], 0.5);
  EXPECT_EQ(lights[0]["direction"], nlohmann::json({0, -1, 0}));
  EXPECT_EQ(lights[1]["type"], "sphere");
  EXPECT_EQ(lights[1]["radius"], 0.25);
  EXPECT_EQ(lights[1]["color"], nlohmann::json({1, 2, 3}));
}

TEST(PresetsCommand, ListsEveryPresetWithWhatItSets) {
  const TemporaryFolder folder;
  const std::string list = runProgramIn(folder, "presets").out;
  for (const char* text : {"deferred", "kastrati2017", "hu2014", "reference", "halfsilver", "trace.method=attributes",
                           "abuffer.buffers=three"})
    EXPECT_NE(list.find(text), std::string::npos) << text;
}

}  // namespace
}  // namespace halfsilver
