#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include "temporary_folder.h"

namespace halfsilver {
namespace {

std::string problemOf(const std::string& text) {
  Settings settings;
  try {
    applySettingsText(settings, text, "a.toml");
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::badInput);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "accepted: " << text;
  return {};
}

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

TEST(SettingsFile, SetsWhatItNamesAndNothingElse) {
  Settings settings;
  applySettingsText(settings,
                    "select.mode = \"all\"\n[voxels]\nresolution = 32\n[abuffer]\nsorted = true\n"
                    "[image]\nexposure = -1.5\n",
                    "a.toml");
  EXPECT_EQ(settings.select.mode, SelectMode::all);
  EXPECT_EQ(settings.voxels.resolution, 32);
  EXPECT_TRUE(settings.attributes.sorted);
  EXPECT_FLOAT_EQ(settings.image.exposure, -1.5f);
  Settings expected;
  expected.select.mode = SelectMode::all;
  expected.voxels.resolution = 32;
  expected.attributes.sorted = true;
  expected.image.exposure = -1.5f;
  const auto values = describe(settings), wanted = describe(expected);
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(values[i].value, wanted[i].value) << values[i].name;
}

// Every setting changed from its default, one at a time and all at once.
TEST(SettingsFile, TextOfSettingsReadsBackAsThem) {
  EXPECT_EQ(settingsText({}), "");
  Settings all;
  for (const SettingInfo& info : describe({})) {
    std::string other = info.value == "true" ? "false" : "true";
    if (info.kind == SettingInfo::Kind::choice)
      other = info.choices[0] == info.value ? info.choices[1] : info.choices[0];
    if (info.kind == SettingInfo::Kind::integer) {
      const int low = static_cast<int>(info.low), high = static_cast<int>(info.high);
      other = std::to_string(info.value == std::to_string(low) ? high : low);
    }
    if (info.kind == SettingInfo::Kind::real) other = "0.12345";
    Settings one, read;
    set(one, info.name, other);
    set(all, info.name, other);
    applySettingsText(read, settingsText(one), "a.toml");
    EXPECT_EQ(read, one) << info.name;
    EXPECT_NE(read, Settings()) << info.name;
  }
  Settings read;
  applySettingsText(read, settingsText(all), "a.toml");
  EXPECT_EQ(read, all);
}

TEST(SettingsFile, TextOfSettingsNamesWhatItMust) {
  Settings settings;
  settings.select.mode = SelectMode::all;
  settings.identity.voxelsPerTriangle = 2.5f;
  const std::string always[] = {"trace.method", "voxels.resolution"};
  EXPECT_EQ(settingsText(settings, always),
            "[select]\nmode = \"all\"\n\n[voxels]\nresolution = 512\nper_triangle = 2.5\n\n[trace]\nmethod = "
            "\"identity\"\n");
}

TEST(SettingsFile, NumbersMayHaveAWord) {
  Settings settings;
  applySettingsText(settings, "[voxels]\nresolution = \"auto\"\n", "a.toml");
  EXPECT_EQ(settings.voxels.resolution, 0);
  EXPECT_EQ(settingsText(settings), "[voxels]\nresolution = \"auto\"\n");
}

TEST(SettingsFile, NamesFileAndLineOfWhatIsWrong) {
  EXPECT_EQ(problemOf("[voxels]\nresolution = 32\nresolutoin = 3\n"), "a.toml:3: unknown setting 'voxels.resolutoin'");
  EXPECT_EQ(problemOf("\n[nonsense]\na = 1\n"), "a.toml:2: unknown section [nonsense]");
  EXPECT_EQ(problemOf("[voxels]\nresolution = \"32\"\n"),
            "a.toml:2: setting voxels.resolution: must be a whole number or \"auto\"");
  EXPECT_EQ(problemOf("[voxels]\nresolution = 3.5\n"),
            "a.toml:2: setting voxels.resolution: must be a whole number or \"auto\"");
  EXPECT_EQ(problemOf("[abuffer]\nsorted = 1\n"), "a.toml:2: setting abuffer.sorted: must be true or false");
  EXPECT_EQ(problemOf("[select]\nmode = true\n"), "a.toml:2: setting select.mode: must be a quoted string");
  EXPECT_EQ(problemOf("[select]\nmode = []\n"), "a.toml:2: setting select.mode: must be a quoted string");
  EXPECT_TRUE(problemOf("[voxels]\n\nresolution = 0\n").starts_with("a.toml:3: setting voxels.resolution: '0' is not"));
  EXPECT_TRUE(problemOf("[image]\nexposure = nan\n").starts_with("a.toml:2: setting image.exposure: 'nan' is not"));
  EXPECT_TRUE(
      problemOf("[select]\nmode = \"some\"\n").starts_with("a.toml:2: setting select.mode: 'some' is not one of"));
  EXPECT_TRUE(problemOf("[voxels]\nresolution = = 3\n").starts_with("a.toml:2: "));
  EXPECT_TRUE(problemOf("voxels = 3\n").starts_with("a.toml:1: "));
  EXPECT_TRUE(problemOf("[voxels.resolution]\na = 3\n").starts_with("a.toml:1: "));
  EXPECT_TRUE(problemOf("\xff\xfe\x00").starts_with("a.toml:1: "));
}

TEST(SettingsFile, WhatTheParserDoesNotSurviveHasItsLine) {
  EXPECT_EQ(problemOf("[|name]"), "a.toml:1: not valid TOML");
  EXPECT_EQ(problemOf("[voxels]\nresolution = 32\n\n[|name]\n\n[image]\n"), "a.toml:4: not valid TOML");
  EXPECT_EQ(problemOf("[voxels]\nresolution = 32\n# ends here\n[.name]"), "a.toml:4: not valid TOML");
  // What it quotes stays on the line: problemOf() looks for line ends.
  EXPECT_TRUE(problemOf("\n[effect]\nglossy = fal\n").starts_with("a.toml:3: "));
}

TEST(SettingsFile, KeysOfVeryManyPartsAreRefused) {
  std::string key = "a";
  for (int i = 0; i < 300000; ++i) key += ".a";
  EXPECT_EQ(problemOf("\n[" + key + "]\n"), "a.toml:2: a key has more than 32 parts");
  EXPECT_EQ(problemOf("\n\n" + key + " = 1\n"), "a.toml:3: a key has more than 32 parts");
  std::string nested, part = "{" + key.substr(0, 63) + " = [\n";
  for (int i = 0; i < 120; ++i) nested += part;
  EXPECT_TRUE(problemOf("[voxels]\nresolution = " + nested).starts_with("a.toml:"));
}

TEST(SettingsFile, CommentsMayHoldAnything) {
  Settings settings;
  applySettingsText(settings,
                    "\xef\xbb\xbf# caf\xc3\xa9 \xff ..........................................\n[voxels] # "
                    "\xe2\x80\x83\nresolution = 32\n# \"a." +
                        repeated(" a.", 40) + "\n",
                    "a.toml");
  EXPECT_EQ(settings.voxels.resolution, 32);
  // Neither a string nor one that begins above hides a key.
  const std::string key = repeated("a.", 40) + "a = 1\n";
  EXPECT_NE(problemOf("b = \"#\"\n" + key).find("more than 32 parts"), std::string::npos);
  EXPECT_NE(problemOf("b = {c = \"\"\"\n# \"\"\", " + key).find("more than 32 parts"), std::string::npos);
  EXPECT_NE(problemOf("\"\\\"#\"." + key).find("more than 32 parts"), std::string::npos);
  EXPECT_TRUE(problemOf("[primary]\nhits \xc3\x9c = 1\n").starts_with("a.toml:2: "));
}

TEST(SettingsFile, LeavesTheSettingsAloneIfSomethingIsWrong) {
  Settings settings;
  EXPECT_THROW(applySettingsText(settings, "[abuffer]\nresolution = 64\nwrong = 1\n", "a.toml"), Error);
  EXPECT_EQ(settings.abuffer.resolution, Settings{}.abuffer.resolution);
}

TEST(SettingsFile, ReadsFiles) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.toml") << "[search]\nsteps = 3\n";
  std::ofstream(folder / "empty.toml");
  Settings settings;
  applySettingsFile(settings, folder / "a.toml");
  applySettingsFile(settings, folder / "empty.toml");
  EXPECT_EQ(settings.attributes.steps, 3);
  EXPECT_THROW(applySettingsFile(settings, folder / "missing.toml"), Error);
  EXPECT_THROW(applySettingsFile(settings, folder.path()), Error);
}

TEST(Presets, AreThePublishedSystemsAndHoldNoDefaults) {
  std::map<std::string, Preset> byName;
  for (const Preset& preset : presets()) {
    EXPECT_FALSE(preset.description.empty()) << preset.name;
    byName[preset.name] = preset;
  }
  for (const char* name : {"deferred", "kastrati2017", "hu2014", "reference", "bvh", "screen-space", "screen-first",
                           "planar", "cubemap", "voxels", "halfsilver"})
    ASSERT_TRUE(byName.count(name)) << name;
  EXPECT_TRUE(byName["halfsilver"].values.empty());
  Settings automatic;
  automatic.trace.method = "auto";
  applyPreset(automatic, "halfsilver");
  EXPECT_EQ(automatic.trace.method, "identity");
  // Everything in a file is a change: as many values as lines "key = value".
  for (const PresetFile& file : presetFiles()) {
    std::size_t assignments = 0;
    bool lineStart = true, comment = false;
    for (const char c : file.text) {
      if (lineStart) comment = c == '#';
      lineStart = c == '\n';
      assignments += c == '=' && !comment;
    }
    // The programs' default is trace.method=auto, so this one names its method.
    if (file.name == "halfsilver") --assignments;
    EXPECT_EQ(byName[std::string(file.name)].values.size(), assignments) << file.name << " repeats a default";
  }
}

TEST(Presets, ApplyByName) {
  Settings settings;
  applyPreset(settings, "kastrati2017");
  EXPECT_EQ(settings.trace.method, "attributes");
  EXPECT_EQ(settings.select.mode, SelectMode::reflective);
  EXPECT_EQ(settings.attributes.buffers, Buffers::single);
  EXPECT_EQ(settings.attributes.lists, Lists::pages);
  EXPECT_EQ(settings.attributes.pageSize, 4);
  EXPECT_EQ(settings.abuffer.resolution, 1024);
  EXPECT_EQ(settings.voxels.resolution, 64);
  EXPECT_EQ(settings.attributes.steps, 3);
  EXPECT_EQ(settings.voxels.raster, VoxelRaster::shifted);
  EXPECT_EQ(settings.trace.stage, TraceStage::fragment);
  settings = {};
  applyPreset(settings, "kastrati2017-complex");
  EXPECT_EQ(settings.voxels.resolution, 256);
  settings.voxels.resolution = 64;
  Settings simple;
  applyPreset(simple, "kastrati2017");
  EXPECT_EQ(settings, simple) << "the same but for the voxels";
  settings = {};
  applyPreset(settings, "burger2007");
  EXPECT_EQ(settings.trace.method, "depth-cube");
  EXPECT_EQ(settings.abuffer.resolution, 1024);
  EXPECT_EQ(settings.depthCube.depth, CubeDepth::half);
  EXPECT_FLOAT_EQ(settings.depthCube.tolerance, 0.001f);
  settings = {};
  applyPreset(settings, "beck2005");
  EXPECT_EQ(settings.trace.method, "exact");
  EXPECT_EQ(settings.trace.bounces, 1) << "the paper's depth";
  EXPECT_EQ(settings.shadow.method, ShadowMethod::refined);
  EXPECT_EQ(settings.shadow.kernel, 5);
  settings = {};
  applyPreset(settings, "robert2007-tested");
  EXPECT_EQ(settings.primary.hits, PrimaryHits::tested);
  EXPECT_EQ(settings.primary.multisampling, Multisampling::lazy);
  EXPECT_EQ(settings.primary.neighborhood, 3);
  settings.primary = {};
  Settings direct;
  applyPreset(direct, "robert2007");
  EXPECT_EQ(settings, direct) << "the same but for the test";
  EXPECT_EQ(direct.trace.bounces, 3);
  settings = {};
  applyPreset(settings, "hu2014");
  EXPECT_EQ(settings.select.mode, SelectMode::all);
  EXPECT_EQ(settings.attributes.buffers, Buffers::three);
  EXPECT_EQ(settings.attributes.lists, Lists::linked);
  EXPECT_TRUE(settings.attributes.sorted);
  EXPECT_EQ(settings.attributes.test, InsideTest::depth);
  EXPECT_EQ(settings.attributes.steps, 3);
  EXPECT_EQ(settings.attributes.anyHitRefinements, 0);
  EXPECT_EQ(settings.abuffer.resolution, 1280);
  EXPECT_EQ(settings.voxels.resolution, 64);
  try {
    applyPreset(settings, "nosuch");
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_NE(std::string(error.what()).find("kastrati2017"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace halfsilver
