#include <gtest/gtest.h>
#include <algorithm>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include <halfsilver/io.h>
#include "program.h"

namespace halfsilver {
namespace {

void expectDone(const ProgramResult& result) { ASSERT_EQ(result.exitCode, 0) << result.err; }

std::size_t distinctColors(const Image& image) {
  std::set<std::vector<float>> colors;
  const auto stride = static_cast<std::ptrdiff_t>(image.channels.size());
  for (auto pixel = image.data.begin(); pixel != image.data.end(); pixel += stride)
    colors.insert(std::vector<float>(pixel, pixel + 3));
  return colors.size();
}

// Expects what holds for every method; returns the fraction of selected pixels.
double checkLayers(const Image& layers, bool tracesAll, bool tracesNone, bool meetsThings = true) {
  for (const char* name :
       {"R", "G", "B", "A", "depth.Z", "normal.X", "normal.Y", "normal.Z", "reflectivity.Y", "selected.Y", "hit.T",
        "hit.id", "hit.nx", "hit.ny", "hit.nz", "reflection.R", "reflection.G", "reflection.B"})
    EXPECT_GE(layers.channel(name), 0) << name;
  std::size_t selected = 0, hits = 0, surfaces = 0, wrong = 0;
  for (const float value : layers.data) wrong += !std::isfinite(value);
  EXPECT_EQ(wrong, 0u) << "values that are not finite";
  for (int y = 0; y < layers.height; ++y) {
    for (int x = 0; x < layers.width; ++x) {
      const auto at = [&](const char* name) { return valueAt(layers, name, x, y); };
      const float t = at("hit.T");
      const bool chosen = at("selected.Y") == 1, surface = at("depth.Z") > 0;
      wrong += at("selected.Y") != 0 && at("selected.Y") != 1;
      wrong += chosen && !surface;
      wrong += chosen && !(t >= 0 || t == -1 || t == -3);
      wrong += !chosen && t != -2;
      wrong += (t >= 0) != (at("hit.id") >= 0);
      wrong += t < 0 && at("hit.id") != -1;
      const float normal = std::hypot(at("normal.X"), at("normal.Y"), at("normal.Z"));
      wrong += surface && std::abs(normal - 1) > 1e-3f;
      const float hitNormal = std::hypot(at("hit.nx"), at("hit.ny"), at("hit.nz"));
      wrong += t >= 0 && std::abs(hitNormal - 1) > 2e-2f;
      wrong += !tracesAll && chosen && !(at("reflectivity.Y") > 0);
      selected += chosen;
      surfaces += surface;
      hits += t >= 0;
    }
  }
  EXPECT_EQ(wrong, 0u) << "pixels or values that break an invariant";
  EXPECT_GT(surfaces, layers.pixelCount() / 4);
  EXPECT_LT(surfaces, layers.pixelCount()) << "no sky in sight";
  if (tracesNone) {
    EXPECT_EQ(selected, 0u);
  }
  if (!tracesNone) {
    EXPECT_EQ(hits > 0, meetsThings);
  }
  if (tracesAll) {
    EXPECT_EQ(selected, surfaces);
  }
  return static_cast<double>(selected) / static_cast<double>(layers.pixelCount());
}

struct PresetCase {
  const char* name;
  bool tracesAll, tracesNone;
};

class EveryPreset : public testing::TestWithParam<PresetCase> {};

TEST_P(EveryPreset, PictureLayersAndStatisticsAgree) {
  const PresetCase preset = GetParam();
  const std::string name = preset.name;
  const bool onTheCpu = name == "reference" || name.starts_with("robert2007") || name == "beck2005";
  if (onTheCpu && !HALFSILVER_EXACT) GTEST_SKIP() << "built without Embree";
  const TemporaryFolder folder;
  const ProgramResult result =
      runProgramIn(folder, kQuickSphere + "--preset " + preset.name + " -o a.png --stats s.json --layers l.exr");
  expectDone(result);
  EXPECT_EQ(result.err, "") << "progress or warnings in a pipe";
  EXPECT_NE(result.out.find("composite"), std::string::npos) << result.out;
  EXPECT_EQ(filesIn(folder), (std::vector<std::string>{"a.png", "l.exr", "s.json"}));

  const ImageFile picture = readImage(folder / "a.png");
  EXPECT_EQ(picture.image.width, 64);
  EXPECT_EQ(picture.image.height, 36);
  EXPECT_GT(distinctColors(picture.image), 200u);
  const ImageFile layers = readImage(folder / "l.exr");
  const double coverage =
      checkLayers(layers.image, preset.tracesAll, preset.tracesNone, name != "planar");  // a ball has no plane
  const auto json = readJson(folder / "s.json");
  EXPECT_NEAR(json["pixels"]["coverage"].get<double>(), coverage, 1e-9);
  ASSERT_TRUE(layers.diagonal.has_value());
  EXPECT_NEAR(*layers.diagonal, json["scene"]["diagonal"].get<double>(), 1e-4);
  EXPECT_EQ(json["memory"]["structure_total"] > 0, !preset.tracesNone);
}

INSTANTIATE_TEST_SUITE_P(Render, EveryPreset,
                         testing::Values(PresetCase{"deferred", false, true}, PresetCase{"kastrati2017", false, false},
                                         PresetCase{"hu2014", true, false}, PresetCase{"burger2007", false, false},
                                         PresetCase{"beck2005", false, false}, PresetCase{"robert2007", false, false},
                                         PresetCase{"robert2007-tested", false, false},
                                         PresetCase{"reference", false, false}, PresetCase{"bvh", false, false},
                                         PresetCase{"screen-space", false, false},
                                         PresetCase{"screen-first", false, false}, PresetCase{"planar", false, false},
                                         PresetCase{"cubemap", false, false}, PresetCase{"voxels", false, false},
                                         PresetCase{"halfsilver", false, false}, PresetCase{"occlusion", true, false},
                                         PresetCase{"path", true, false}, PresetCase{"whitted", true, false}),
                         [](const auto& instance) {
                           std::string name = instance.param.name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Render, StatisticsHaveTheContractsSchema) {
  const TemporaryFolder folder;
  expectDone(runProgramIn(folder, kQuickSphere + "-o a.png --stats s.json --repeat 3"));
  const auto json = readJson(folder / "s.json");
  for (const char* key : {"vendor", "renderer", "version", "context"}) {
    EXPECT_TRUE(json["device"][key].is_string()) << key;
    EXPECT_NE(json["device"][key], "") << key;
  }
  EXPECT_EQ(json["scene"]["file"], "builtin:sphere");
  EXPECT_GT(json["scene"]["triangles"], 100);
  EXPECT_GT(json["scene"]["materials"], 1);
  EXPECT_EQ(json["settings"]["voxels.resolution"], 16);
  EXPECT_EQ(json["pixels"]["total"], 64 * 36);
  EXPECT_GT(json["pixels"]["selected"], 0);
  const double share = json["pixels"]["selected"].get<double>() / (64 * 36);
  EXPECT_DOUBLE_EQ(json["pixels"]["coverage"].get<double>(), share);
  const auto& memory = json["memory"];
  for (const char* key :
       {"voxels", "heads", "pool_reserved", "pool_used", "fragments", "fragments_stored", "structure_total", "gbuffer",
        "geometry", "textures", "shadow_maps", "queues", "transient", "peak", "largest_buffer"})
    EXPECT_TRUE(memory[key].is_number_unsigned()) << key;
  EXPECT_LE(memory["pool_used"], memory["pool_reserved"]);
  EXPECT_LE(memory["fragments_stored"], memory["fragments"]);
  EXPECT_GE(memory["structure_total"].get<std::uint64_t>(), memory["voxels"].get<std::uint64_t>() +
                                                                memory["heads"].get<std::uint64_t>() +
                                                                memory["pool_reserved"].get<std::uint64_t>());
  EXPECT_GT(memory["peak"], memory["structure_total"]);
  EXPECT_GE(memory["largest_buffer"], memory["pool_reserved"]);
  EXPECT_NE(memory["largest_buffer_name"], "");
  for (const char* stage :
       {"shadow", "gbuffer", "select", "voxelize", "build", "trace", "shade", "composite", "frame"}) {
    const auto& time = json["time_ms"][stage];
    ASSERT_TRUE(time.is_object()) << stage;
    EXPECT_LE(time["min"], time["median"]) << stage;
    EXPECT_LE(time["median"], time["max"]) << stage;
    EXPECT_GE(time["runs"].get<int>(), 1) << stage;
    EXPECT_GT(time["median"], 0) << stage;  // of the first frame if later ones keep what it made
  }
  const auto& frame = json["time_ms"]["frame"];
  EXPECT_EQ(frame["runs"].get<int>() + frame["rejected"].get<int>(), 3);
  EXPECT_GT(frame["median"], json["time_ms"]["trace"]["median"]);
  EXPECT_EQ(json["overflow"], 0);
  EXPECT_TRUE(json["warnings"].is_array());
}

TEST(Render, TwoRunsAreIdentical) {
  const TemporaryFolder folder;
  expectDone(runProgramIn(folder, kQuickSphere + "-o a.png --layers a.exr"));
  expectDone(runProgramIn(folder, kQuickSphere + "-o b.png --layers b.exr"));
  EXPECT_TRUE(readText(folder / "a.png") == readText(folder / "b.png"));
  EXPECT_TRUE(readText(folder / "a.exr") == readText(folder / "b.exr"));
}

TEST(Render, LinearPictureIsTheLayersColor) {
  const TemporaryFolder folder;
  expectDone(runProgramIn(folder, kQuickSphere + "--preset deferred -o a.exr --layers l.exr"));
  const Image picture = readImage(folder / "a.exr").image, layers = readImage(folder / "l.exr").image;
  EXPECT_EQ(picture.channelCount(), 4);
  for (const char* channel : {"R", "G", "B", "A"})
    for (int x = 0; x < picture.width; x += 7)
      EXPECT_EQ(valueAt(picture, channel, x, 30), valueAt(layers, channel, x, 30)) << channel << ' ' << x;
}

TEST(Render, WorldCamerasKeepTheirPrecisionFarAway) {
  for (const double east : {0.0, 5e6}) {
    SCOPED_TRACE(east);
    const TemporaryFolder folder;
    writeWall(folder, east);
    const std::string x = std::to_string(east);
    expectDone(
        runProgramIn(folder, "render wall.gltf --preset deferred --size 33x33 -o a.png --layers l.exr --fov 60 --eye " +
                                 x + ",0,7.5 --target " + x + ",0,0"));
    const Image layers = readImage(folder / "l.exr").image;
    EXPECT_NEAR(valueAt(layers, "depth.Z", 16, 16), 7.5, 1e-4);
    EXPECT_NEAR(valueAt(layers, "depth.Z", 3, 29), 7.5, 1e-4) << "depth is along the view axis";
    EXPECT_NEAR(valueAt(layers, "normal.Z", 16, 16), 1, 1e-6);
  }
}

TEST(Render, CamerasByNameAndIndexAndTheDefaultAreTheSame) {
  const TemporaryFolder folder;
  writeWall(folder);
  const std::string render = "render wall.gltf --preset deferred --size 16x9 ";
  expectDone(runProgramIn(folder, render + "-o a.exr --layers a2.exr"));
  expectDone(runProgramIn(folder, render + "-o b.exr --camera near"));
  expectDone(runProgramIn(folder, render + "-o c.exr --camera 0"));
  expectDone(runProgramIn(folder, render + "-o d.exr --fov 20"));
  EXPECT_TRUE(readText(folder / "a.exr") == readText(folder / "b.exr"));
  EXPECT_TRUE(readText(folder / "a.exr") == readText(folder / "c.exr"));
  EXPECT_NEAR(valueAt(readImage(folder / "a2.exr").image, "depth.Z", 8, 4), 5, 1e-4);
}

TEST(Render, MirrorsHaveTheGivenReflectanceAndUseTheSky) {
  const TemporaryFolder folder;
  writeWall(folder);
  Image sky{4, 2, {"R", "G", "B"}, {}};
  for (int i = 0; i < 8; ++i) sky.data.insert(sky.data.end(), {2.0f, 0.5f, 0.25f});
  const std::vector<std::byte> bytes = encodeExr(sky);
  std::ofstream(folder / "sky.exr", std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
  const std::string render = "render wall.gltf --size 33x33 --sky sky.exr --set shadow.sky_directions=0 ";
  expectDone(runProgramIn(folder, render + "-o a.png --layers l.exr --mirror '*=0.25' --mirror paint=1"));
  const Image layers = readImage(folder / "l.exr").image;
  EXPECT_NEAR(valueAt(layers, "reflectivity.Y", 16, 16), 1, 1e-6) << "the last --mirror wins";
  EXPECT_EQ(valueAt(layers, "selected.Y", 16, 16), 1);
  EXPECT_EQ(valueAt(layers, "hit.T", 16, 16), -1);
  // A perfect mirror of a constant sky shows that sky.
  EXPECT_NEAR(valueAt(layers, "R", 16, 16), 2, 1e-3);
  EXPECT_NEAR(valueAt(layers, "G", 16, 16), 0.5, 1e-3);
  EXPECT_NEAR(valueAt(layers, "B", 16, 16), 0.25, 1e-3);
}

// The middle of the back wall, 1 m from the point: a matte surface sends back its share, over pi.
TEST(Render, LightsOfTheCommandLineAddToThoseOfTheScene) {
  const TemporaryFolder folder;
  const std::string render = "render builtin:cornell-empty --size 33x33 -o a.png --layers ";
  expectDone(runProgramIn(folder, render + "plain.exr"));
  expectDone(runProgramIn(folder, render + "lit.exr --light point:0,1,0:3.14159,0,0 --light point:0,1,0:0,6.28318,0"));
  const Image plain = readImage(folder / "plain.exr").image, lit = readImage(folder / "lit.exr").image;
  const auto added = [&](const char* channel) {
    return valueAt(lit, channel, 16, 16) - valueAt(plain, channel, 16, 16);
  };
  EXPECT_GT(valueAt(plain, "R", 16, 16), 0.05) << "the lamp lights the wall";
  EXPECT_NEAR(added("R"), 0.75, 5e-3);
  EXPECT_NEAR(added("G"), 1.5, 1e-2);
  EXPECT_EQ(added("B"), 0);
}

TEST(Render, SettingsComeInOrder) {
  const TemporaryFolder folder;
  writeWall(folder);
  std::ofstream(folder / "a.toml") << "[voxels]\nresolution = 32\n[trace]\nbounces = 2\n[abuffer]\nresolution = 64\n";
  expectDone(runProgramIn(folder,
                          "render wall.gltf --size 8x8 -o a.png --stats s.json --config a.toml --bounces 3 "
                          "--set voxels.resolution=8 --set trace.bounces=4"));
  const auto settings = readJson(folder / "s.json")["settings"];
  EXPECT_EQ(settings["abuffer.resolution"], 64);
  EXPECT_EQ(settings["voxels.resolution"], 8);
  EXPECT_EQ(settings["trace.bounces"], 3);
}

TEST(Render, WarningsGoToStderrAndTheStatistics) {
  const TemporaryFolder folder;
  writeWall(folder);
  const ProgramResult result =
      runProgramIn(folder, "render wall.gltf --preset deferred --size 8x8 -o a.png --stats s.json --time 1");
  expectDone(result);
  EXPECT_NE(result.err.find("warning: the scene has no animation"), std::string::npos) << result.err;
  bool found = false;
  const nlohmann::json json = readJson(folder / "s.json");
  for (const auto& warning : json["warnings"])
    found |= warning.get<std::string>().find("no animation") != std::string::npos;
  EXPECT_TRUE(found);
}

TEST(Render, MemoryBudgetIsMetAndReported) {
  const TemporaryFolder folder;
  const std::string render = kQuickSphere + "--set voxels.resolution=256 ";
  expectDone(runProgramIn(folder, render + "-o a.png --stats a.json"));
  const auto whole = readJson(folder / "a.json");
  const double least = whole["memory"]["voxels"], most = whole["memory"]["structure_total"];
  ASSERT_GT(most, 1.2 * least);
  const std::string limit = std::to_string(1e-6 * (least + 0.8 * (most - least)));
  const ProgramResult result = runProgramIn(folder, render + "-o b.png --stats b.json --budget-mb " + limit);
  expectDone(result);
  EXPECT_NE(result.out.find("budget"), std::string::npos) << result.out;
  const auto json = readJson(folder / "b.json");
  EXPECT_TRUE(json["budget"]["settled"].get<bool>());
  EXPECT_EQ(json["budget"]["frames"], 1);
  EXPECT_EQ(json["budget"]["frames_held"], 1);
  EXPECT_TRUE(json["budget"]["milliseconds"].is_null());
  EXPECT_LE(json["memory"]["structure_total"].get<double>(), 1e6 * json["budget"]["megabytes"].get<double>());
  EXPECT_GT(json["budget"]["min_contribution"], 0);
  EXPECT_GT(json["pixels"]["selected"], 0);
  EXPECT_EQ(json["pixels"]["reflecting"], whole["pixels"]["selected"]);
  EXPECT_GT(json["budget"]["dropped"], 0);
  EXPECT_EQ(json["budget"]["dropped"].get<int>(),
            json["pixels"]["reflecting"].get<int>() - json["pixels"]["selected"].get<int>());
  EXPECT_NE(readText(folder / "a.png"), readText(folder / "b.png"));
}

TEST(Render, TimeBudgetDropsEverythingIfItCannotBeMetAndNothingIfItIsLarge) {
  const TemporaryFolder folder;
  const ProgramResult small = runProgramIn(folder, kQuickSphere + "-o a.png --stats a.json --budget-ms 0.001");
  expectDone(small);
  EXPECT_NE(small.err.find("budget"), std::string::npos) << small.err;
  const auto none = readJson(folder / "a.json");
  EXPECT_EQ(none["budget"]["frames_held"], 0);
  EXPECT_EQ(none["pixels"]["selected"], 0);
  EXPECT_GT(none["budget"]["dropped"], 100);
  expectDone(runProgramIn(folder, kQuickSphere + "-o b.png --stats b.json --budget-ms 1e6"));
  const auto all = readJson(folder / "b.json");
  EXPECT_EQ(all["budget"]["dropped"], 0);
  EXPECT_EQ(all["budget"]["min_contribution"], 0);
  expectDone(runProgramIn(folder, kQuickSphere + "-o c.png --stats c.json"));
  EXPECT_FALSE(readJson(folder / "c.json").contains("budget"));
  EXPECT_TRUE(readText(folder / "b.png") == readText(folder / "c.png"));
}

TEST(Render, TimeBudgetsOfOtherEffectsSendFewerRaysPerPixel) {
  const TemporaryFolder folder;
  const std::string render = kQuickSphere + "--preset occlusion --set effect.samples=4 --passes 3 ";
  const ProgramResult small = runProgramIn(folder, render + "-o a.png --stats a.json --budget-ms 0.001");
  expectDone(small);
  EXPECT_NE(small.err.find("budget"), std::string::npos) << small.err;
  EXPECT_NE(small.out.find("1 of 12 rays per pixel"), std::string::npos) << small.out;
  const auto few = readJson(folder / "a.json");
  EXPECT_EQ(few["budget"]["rays_per_pixel"], 1);
  EXPECT_EQ(few["budget"]["frames_held"], 0);
  expectDone(runProgramIn(folder, render + "-o b.png --stats b.json --budget-ms 1e6"));
  const auto all = readJson(folder / "b.json");
  EXPECT_EQ(all["budget"]["rays_per_pixel"], 12);
  EXPECT_EQ(all["rays"]["occlusion"].get<int>(), 12 * few["rays"]["occlusion"].get<int>());
  expectDone(runProgramIn(folder, render + "-o c.png"));
  EXPECT_TRUE(readText(folder / "b.png") == readText(folder / "c.png"));
}

// A device may take no more than 128 MiB per storage block, which is 16 bytes for each of these pixels.
class LargePicture : public testing::TestWithParam<const char*> {};

TEST_P(LargePicture, Draws) {
  if (GetParam() == std::string("reference") && !HALFSILVER_EXACT) GTEST_SKIP() << "built without Embree";
  const TemporaryFolder folder;
  expectDone(runProgramIn(folder, std::string("render builtin:sphere --size 3840x2160 -o a.png --preset ") +
                                      GetParam() +
                                      " --set select.fraction=0.02 --set shadow.resolution=64 "
                                      "--set shadow.sky_directions=0 --set abuffer.resolution=64"));
  const Image image = readImage(folder / "a.png").image;
  EXPECT_EQ(image.width, 3840);
  EXPECT_EQ(image.height, 2160);
  EXPECT_GT(distinctColors(image), 1000u);
}

INSTANTIATE_TEST_SUITE_P(Presets, LargePicture, testing::Values("halfsilver", "reference", "kastrati2017"),
                         [](const auto& preset) { return std::string(preset.param); });

TEST(Render, ReplacesAnOldPicture) {
  const TemporaryFolder folder;
  writeWall(folder);
  std::ofstream(folder / "a.png") << "old";
  EXPECT_NE(runProgramIn(folder, "render missing.gltf --size 8x8 -o a.png").exitCode, 0);
  EXPECT_EQ(readText(folder / "a.png"), "old");
  expectDone(runProgramIn(folder, "render wall.gltf --preset deferred --size 8x8 -o a.png"));
  EXPECT_EQ(readImage(folder / "a.png").image.width, 8);
}

// The mean of four frames: the same bytes on any number of the device's threads.
TEST(Samples, GiveTheSamePictureWhateverTheThreads) {
  const TemporaryFolder folder;
  expectDone(runProgramIn(folder, kQuickSphere + "-o one.exr --layers one_layers.exr"));
  for (const std::string threads : {"0", "2"})
    expectDone(runProgramIn(
        folder, kQuickSphere + "--samples 4 -o " + threads + ".exr --layers layers" + threads + ".exr --stats s.json",
        "LP_NUM_THREADS=" + threads + " "));
  EXPECT_EQ(readText(folder / "0.exr"), readText(folder / "2.exr"));
  EXPECT_EQ(readText(folder / "layers0.exr"), readText(folder / "layers2.exr"));
  EXPECT_NE(readText(folder / "0.exr"), readText(folder / "one.exr"));
  const Image one = readImage(folder / "one_layers.exr").image, four = readImage(folder / "layers0.exr").image;
  EXPECT_EQ(valueAt(four, "depth.Z", 30, 30), valueAt(one, "depth.Z", 30, 30)) << "of the pixels' centers";
  const nlohmann::json statistics = readJson(folder / "s.json");
  EXPECT_EQ(statistics["pixels"]["samples"], 4);
  EXPECT_GT(statistics["memory"]["pictures"].get<int>(), 0);
}

TEST(Samples, HaveARangeAndNoBudget) {
  const TemporaryFolder folder;
  for (const char* wrong : {"--samples 0", "--samples 4097", "--samples 4 --budget-ms 5"}) {
    const ProgramResult result = runProgramIn(folder, kQuickSphere + "-o a.png " + wrong);
    EXPECT_EQ(result.exitCode, 2) << wrong;
    EXPECT_NE(result.err.find("samples"), std::string::npos) << result.err;
  }
}

TEST(Render, TellsWhichEffectsShowGlassAndCoats) {
  const TemporaryFolder folder;
  const std::string glass = "render builtin:glass --size 32x20 -o a.png ";
  EXPECT_NE(runProgramIn(folder, glass + "--set trace.method=planar").err.find("transmit light"), std::string::npos);
  for (const char* effect : {"reflection", "whitted", "path"}) {
    const ProgramResult result = runProgramIn(folder, glass + "--set trace.effect=" + effect);
    expectDone(result);
    EXPECT_EQ(result.err, "");
  }
}

// A picture that refines is the picture that comes at once, and its rays are the same.
TEST(Passes, GiveTheSamePictureInOneFrameOrInSeveral) {
  const TemporaryFolder folder;
  const std::string path = kQuickSphere + "--set trace.effect=path --set effect.samples=2 --passes 5 ";
  expectDone(runProgramIn(folder, path + "-o a.exr --stats a.json", "LP_NUM_THREADS=0 "));
  expectDone(runProgramIn(folder, path + "-o b.exr --stats b.json --progress-every 2"));
  EXPECT_EQ(readText(folder / "a.exr"), readText(folder / "b.exr"));
  const nlohmann::json a = readJson(folder / "a.json"), b = readJson(folder / "b.json");
  EXPECT_EQ(a["rays"], b["rays"]);
  EXPECT_GT(a["rays"]["scattered"].get<int>(), 5 * a["pixels"]["selected"].get<int>());
  EXPECT_EQ(b["pixels"]["passes"], 5);
  EXPECT_GT(distinctColors(readImage(folder / "a.exr").image), 500u);
}

TEST(Passes, AreWrittenOnlyOfASinglePicture) {
  const TemporaryFolder folder;
  for (const char* wrong :
       {"--passes 0", "--passes 4", "--progress-every 2 --samples 4", "--progress-every 2 --repeat 3"}) {
    const ProgramResult result = runProgramIn(folder, kQuickSphere + "-o a.png " + wrong);
    EXPECT_EQ(result.exitCode, 2) << wrong;
    EXPECT_NE(result.err.find(std::string(wrong).substr(0, 6)), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
  }
}

TEST(Render, SaysWhichMethodAutoHasChosenAndWhy) {
  const TemporaryFolder folder;
  const ProgramResult result = runProgramIn(folder, "render builtin:sphere --size 64x36 -o a.png --stats s.json");
  expectDone(result);
  const nlohmann::json json = readJson(folder / "s.json");
  const std::string method = json["auto"]["method"];
  EXPECT_EQ(json["settings"]["trace.method"], method);
  EXPECT_NE(result.out.find("trace.method=auto: " + method + ", "), std::string::npos) << result.out;
  EXPECT_FALSE(json["auto"]["reason"].get<std::string>().empty());
#if HALFSILVER_EXACT
  if (json["device"]["software"].get<bool>()) {
    EXPECT_EQ(method, "exact");
  }
#endif
  // A budget of memory needs a structure that follows the rays.
  expectDone(runProgramIn(folder, "render builtin:sphere --size 64x36 -o a.png --stats s.json --budget-mb 1"));
  EXPECT_EQ(readJson(folder / "s.json")["settings"]["trace.method"], "identity");
}

}  // namespace
}  // namespace halfsilver
