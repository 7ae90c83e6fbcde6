#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "program.h"
#include "shared_scenes.h"

#if HALFSILVER_DEMO

namespace halfsilver {
namespace {

const std::string kQuick = "demo builtin:sphere --size 96x54 --set shadow.resolution=64 --set shadow.sky_directions=0 ";

std::size_t colorsOf(const Image& picture) {
  std::set<std::vector<float>> colors;
  const auto stride = static_cast<std::ptrdiff_t>(picture.channels.size());
  for (auto pixel = picture.data.begin(); pixel != picture.data.end(); pixel += stride)
    colors.insert(std::vector<float>(pixel, pixel + 3));
  return colors.size();
}

TEST(Demo, FramesNeedNoDisplayAndAreTheSameEachTime) {
  const TemporaryFolder folder;
  for (const std::string name : {"a", "b"}) {
    const ProgramResult result = runProgramIn(
        folder, kQuick + "--frames 4 --screenshot " + name + ".png --stats " + name + ".jsonl", "DISPLAY= ");
    ASSERT_EQ(result.exitCode, 0) << result.err;
  }
  EXPECT_TRUE(readText(folder / "a.png") == readText(folder / "b.png"));
  EXPECT_GT(colorsOf(readImage(folder / "a.png").image), 100u);
  std::istringstream lines(readText(folder / "a.jsonl"));
  std::string line;
  int frames = 0;
  while (std::getline(lines, line)) {
    const nlohmann::json figures = nlohmann::json::parse(line);
    EXPECT_EQ(figures["frame"], frames++);
    EXPECT_GT(figures["coverage"], 0.05);
    EXPECT_EQ(figures["overflow"], 0);
    EXPECT_GT(figures["rays"], 100);
    EXPECT_GT(figures["total_bytes"], figures["structure_bytes"]);
    EXPECT_EQ(figures["scale"], 1);
    EXPECT_GT(figures["time_ms"]["frame"], 0);
  }
  EXPECT_EQ(frames, 4);
}

TEST(Demo, TheOverlayGrowsWithTheDisplaysScale) {
  const TemporaryFolder folder;
  const std::string large = "demo builtin:sphere --size 960x540 --set shadow.resolution=64 --frames 1 --screenshot ";
  ASSERT_EQ(runProgramIn(folder, large + "none.png").exitCode, 0);
  ASSERT_EQ(runProgramIn(folder, large + "one.png --overlay --content-scale 0.75").exitCode, 0);
  ASSERT_EQ(runProgramIn(folder, large + "two.png --overlay --content-scale 1.5").exitCode, 0);
  const Image none = readImage(folder / "none.png").image;
  const auto covered = [&](const char* name) {
    const Image picture = readImage(folder / name).image;
    std::size_t count = 0;
    for (std::size_t i = 0; i < picture.data.size(); i += 4) count += picture.data[i] != none.data[i];
    return count;
  };
  EXPECT_GT(covered("one.png"), none.pixelCount() / 20);
  EXPECT_GT(covered("two.png"), 2 * covered("one.png"));
}

TEST(Demo, AnAnimationIsPlayedAloneByNameOrIndex) {
  const std::filesystem::path scene =
      halfsilver::testing::sharedScene("").parent_path().parent_path() / "cases" / "b45_two_animations.gltf";
  HALFSILVER_REQUIRE_SCENE(scene);
  const TemporaryFolder folder;
  const std::string demo = "demo " + scene.string() + " --size 96x54 --set shadow.resolution=64 --set " +
                           "shadow.sky_directions=0 --frames 9 --fps 6 ";
  const auto picture = [&](const std::string& options) {
    const ProgramResult result = runProgramIn(folder, demo + options + " --screenshot picture.png");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return readImage(folder / "picture.png").image.data;
  };
  const std::vector<float> all = picture("");
  const std::vector<float> first = picture("--animation box0Action"), second = picture("--animation 1");
  EXPECT_EQ(picture("--animation all"), all);
  EXPECT_EQ(picture("--animation 0"), first);
  EXPECT_NE(first, all);
  EXPECT_NE(second, all);
  EXPECT_NE(first, second);
  const ProgramResult unknown = runProgramIn(folder, demo + "--animation walk");
  EXPECT_EQ(unknown.exitCode, 2);
  EXPECT_NE(unknown.err.find("box0Action"), std::string::npos) << unknown.err;
  EXPECT_EQ(runProgramIn(folder, "demo --frames 1 --animation walk").exitCode, 2) << "the game has none";
}

TEST(Demo, ASplitScreenShowsAMethodOnEachSide) {
  const TemporaryFolder folder;
  const std::string exact = kQuick + "--preset reference --frames 1 --screenshot ";
  for (const std::string arguments : {"left.png", "both.png --split deferred"})
    ASSERT_EQ(runProgramIn(folder, exact + arguments).exitCode, 0);
  ASSERT_EQ(runProgramIn(folder, kQuick + "--preset deferred --frames 1 --screenshot right.png").exitCode, 0);
  const Image left = readImage(folder / "left.png").image, right = readImage(folder / "right.png").image;
  const Image both = readImage(folder / "both.png").image;
  std::size_t different = 0;
  for (std::size_t i = 0; i < both.data.size(); ++i) {
    const bool isLeft = i / both.channels.size() % static_cast<std::size_t>(both.width) < 48;
    ASSERT_EQ(both.data[i], (isLeft ? left : right).data[i]);
    different += left.data[i] != right.data[i];
  }
  EXPECT_GT(different, 500u) << "the sides are of different methods";
}

TEST(Demo, ShowsWhereAMethodIsWrong) {
  const TemporaryFolder folder;
  const auto share = [&](const std::string& preset, int channel) {
    EXPECT_EQ(runProgramIn(folder, kQuick + "--show error --frames 1 --screenshot a.png --preset " + preset).exitCode,
              0);
    const Image picture = readImage(folder / "a.png").image;
    std::size_t count = 0;
    for (std::size_t i = 0; i < picture.data.size(); i += picture.channels.size()) {
      const auto* rgb = &picture.data[i];
      count += rgb[channel] > 0.3f && rgb[channel] > 2 * rgb[channel == 0 ? 1 : 0];
    }
    return static_cast<double>(count) / static_cast<double>(picture.pixelCount());
  };
  EXPECT_EQ(share("halfsilver", 0), 0) << "no red";
  EXPECT_GT(share("halfsilver", 1), 0.03) << "but green";
  EXPECT_GT(share("kastrati2017", 0), 0.0005) << "red";
}

TEST(Demo, WithoutADisplayAWindowIsRefusedInOneLine) {
  const TemporaryFolder folder;
  const ProgramResult result = runProgramIn(folder, "demo builtin:sphere", "DISPLAY= WAYLAND_DISPLAY= ");
  EXPECT_EQ(result.exitCode, 4);
  EXPECT_NE(result.err.find("no window"), std::string::npos) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

TEST(Demo, WhatIsNoSceneIsRefusedBeforeAnythingIsWritten) {
  const TemporaryFolder folder;
  EXPECT_EQ(runProgramIn(folder, "demo no.glb --frames 1 --screenshot a.png").exitCode, 3);
  EXPECT_EQ(runProgramIn(folder, "demo builtin:sphere --frames 0").exitCode, 2);
  EXPECT_EQ(runProgramIn(folder, "demo builtin:sphere --frames 1 --size x --screenshot a.png").exitCode, 2);
  for (const std::string unknown : {"--show nothing", "--split nothing"})
    EXPECT_EQ(runProgramIn(folder, "demo builtin:sphere --frames 1 --screenshot a.png " + unknown).exitCode, 2);
  EXPECT_TRUE(filesIn(folder).empty());
}

const std::string kQuickGame =
    "demo --size 96x54 --set shadow.resolution=64 --set shadow.sky_directions=0 --screenshot last.png --stats s.jsonl ";

std::vector<nlohmann::json> linesOf(const std::filesystem::path& file) {
  std::istringstream text(readText(file));
  std::vector<nlohmann::json> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(nlohmann::json::parse(line));
  return lines;
}

// Without a player the autopilot plays; what it did is recorded and played again.
TEST(Demo, ARoundIsPlayedToItsEndRecordedAndReplayed) {
  const TemporaryFolder folder;
  const std::string round = kQuickGame + "--frames 150 --fps 2 ";
  const ProgramResult played = runProgramIn(folder, round + "--record round.txt", "DISPLAY= ");
  ASSERT_EQ(played.exitCode, 0) << played.err;
  const std::vector<nlohmann::json> frames = linesOf(folder / "s.jsonl");
  const std::string picture = readText(folder / "last.png");
  ASSERT_EQ(frames.size(), 150u);
  std::set<nlohmann::json> states;
  for (const nlohmann::json& frame : frames) {
    states.insert(frame["status"]);
    EXPECT_EQ(frame["overflow"], 0) << frame["frame"];
  }
  EXPECT_GT(states.size(), 100u) << "the clock runs until the end";
  EXPECT_NE(frames[1]["status"].dump().find(" 0 of 12 stones"), std::string::npos) << frames[1]["status"];
  EXPECT_NE(frames[100]["status"].dump().find(" of 12 stones"), std::string::npos);
  EXPECT_NE(frames.back()["status"].dump().find("12 of 12 stones"), std::string::npos) << frames.back()["status"];
  EXPECT_NE(frames.back()["status"].dump().find("Round finished"), std::string::npos) << frames.back()["status"];

  const ProgramResult replayed = runProgramIn(folder, round + "--replay round.txt", "DISPLAY= ");
  ASSERT_EQ(replayed.exitCode, 0) << replayed.err;
  const std::vector<nlohmann::json> again = linesOf(folder / "s.jsonl");
  ASSERT_EQ(again.size(), frames.size());
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    EXPECT_EQ(again[frame]["status"], frames[frame]["status"]);
    EXPECT_EQ(again[frame]["rays"], frames[frame]["rays"]);
  }
  EXPECT_TRUE(readText(folder / "last.png") == picture);
}

TEST(Demo, RecordingsThatCannotBePlayedAreRefused) {
  const TemporaryFolder folder;
  std::ofstream(folder / "bad.txt") << "halfsilver-recording 1\nsteps-per-second 60\nseed 0\n1 2 x 0 0 0\n";
  const ProgramResult result = runProgramIn(folder, kQuickGame + "--frames 2 --replay bad.txt");
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_NE(result.err.find("bad.txt: line 4"), std::string::npos) << result.err;
  EXPECT_EQ(runProgramIn(folder, kQuickGame + "--frames 2 --replay none.txt").exitCode, 3);
  EXPECT_EQ(runProgramIn(folder, kQuick + "--frames 2 --record r.txt").exitCode, 2);
  EXPECT_EQ(filesIn(folder).size(), 1u) << "only the recording that this test wrote";
}

TEST(Demo, AFrameTimeThatCannotBeHeldLowersTheResolution) {
  const TemporaryFolder folder;
  ASSERT_EQ(runProgramIn(folder, kQuickGame + "--frames 30 --frame-time 0.01").exitCode, 0);
  const std::vector<nlohmann::json> frames = linesOf(folder / "s.jsonl");
  EXPECT_EQ(frames.front()["scale"], 1);
  EXPECT_EQ(frames.back()["scale"], 0.25);
  EXPECT_LT(frames.back()["traced_share"], 0.5);
  EXPECT_LT(frames.back()["width"], 30);
}

TEST(Demo, AWindowOpensAndCloses) {
  if (std::system("command -v xvfb-run >/dev/null 2>&1") != 0) GTEST_SKIP() << "there is no xvfb-run";
  const TemporaryFolder folder;
  const ProgramResult result = runProgramIn(folder, kQuick + "--window --frames 3 --screenshot a.png --stats a.jsonl",
                                            "XDG_CONFIG_HOME=. xvfb-run -a -s '-screen 0 640x480x24' ");
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_GT(colorsOf(readImage(folder / "a.png").image), 100u);
}

}  // namespace
}  // namespace halfsilver

#endif
