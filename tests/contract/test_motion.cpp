#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include <halfsilver/io.h>
#include "program.h"
#include "shared_scenes.h"

namespace halfsilver {
namespace {

// Of ../shared/cases, beside the shared scenes.
std::filesystem::path sharedCase(const std::string& name) {
  return testing::sharedScene("").parent_path().parent_path() / "cases" / (name + ".gltf");
}

#define REQUIRE_CASES() \
  if (!std::filesystem::exists(sharedCase("b04_step_tenths"))) GTEST_SKIP() << "shared cases are absent"

Image layersAt(const std::string& name, const std::string& options) {
  const TemporaryFolder folder;
  const ProgramResult result =
      runProgramIn(folder, "render " + sharedCase(name).string() +
                               " --preset deferred --size 320x180 -o a.png --layers l.exr " + options);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  return result.exitCode == 0 ? readImage(folder / "l.exr").image : Image{};
}

float depthAtCenter(const std::string& name, const std::string& options) {
  const Image layers = layersAt(name, options);
  return layers.width > 0 ? valueAt(layers, "depth.Z", 160, 90) : -1.0f;
}

// Mean column of the pixels that the object covers, by its color: what is not gray.
float columnOf(const Image& layers, float from = 0, float to = 1) {
  double sum = 0;
  std::size_t count = 0;
  for (int y = 0; y < layers.height; ++y)
    for (int x = static_cast<int>(from * static_cast<float>(layers.width));
         x < static_cast<int>(to * static_cast<float>(layers.width)); ++x)
      if (valueAt(layers, "depth.Z", x, y) > 0) {
        sum += x + 0.5;
        ++count;
      }
  EXPECT_GT(count, 20u);
  return static_cast<float>(sum / static_cast<double>(count));
}

TEST(Motion, WindingFollowsTheDeterminantAtTheTimeThatIsDrawn) {
  REQUIRE_CASES();
  for (const char* time : {"0", "0.3", "1", "1.5", "2"})
    for (const char* name : {"b01_animated_mirror", "b01_unmirrored_by_animation"})
      EXPECT_NEAR(depthAtCenter(name, std::string("--time ") + time), 2.5f, 1e-4f) << name << " at " << time;
}

TEST(Motion, ASkinUnderAMirroredArmatureShowsItsFront) {
  REQUIRE_CASES();
  EXPECT_NEAR(depthAtCenter("b02_skin_mirrored_armature", ""), 2.5f, 1e-4f);
  EXPECT_NEAR(depthAtCenter("b02_skin_plain_armature", ""), 2.5f, 1e-4f);
}

TEST(Motion, WhatIsDegenerateAtRestShowsInALaterPose) {
  REQUIRE_CASES();
  for (const char* name :
       {"b03_scale_from_zero", "b03_morph_from_nothing", "b03_joint_from_zero", "b03_scale_from_zero_alone"})
    EXPECT_NEAR(depthAtCenter(name, "--time 1.5"), 2.5f, 1e-4f) << name;
  EXPECT_EQ(depthAtCenter("b03_scale_from_zero_alone", ""), 0) << "empty at rest, and a picture all the same";
}

TEST(Motion, AStepHoldsFromTheTimeOfItsKeyOn) {
  REQUIRE_CASES();
  const float middle = columnOf(layersAt("b04_step_tenths", "--time 0"));
  const float whole = columnOf(layersAt("b04_step_tenths", "--time 1")) - middle;
  ASSERT_GT(whole, 40);
  for (int tenth = 1; tenth < 10; ++tenth)
    EXPECT_NEAR(columnOf(layersAt("b04_step_tenths", "--time 0." + std::to_string(tenth))) - middle,
                whole * static_cast<float>(tenth) / 10, 1.5f)
        << tenth;
}

TEST(Motion, TheDurationThatInfoPrintsIsTheLastPose) {
  REQUIRE_CASES();
  for (const char* name : {"b05_slide_0.4", "b05_slide_0.9"}) {
    const TemporaryFolder folder;
    const ProgramResult info = runProgramIn(folder, "info --json " + sharedCase(name).string());
    ASSERT_EQ(info.exitCode, 0) << info.err;
    const std::string end = nlohmann::json::parse(info.out)["animations"][0]["duration"].dump();
    EXPECT_GT(columnOf(layersAt(name, "--time " + end)), 200) << name << " at " << end;
    EXPECT_LT(columnOf(layersAt(name, "--time 0")), 120) << name;
  }
}

TEST(Motion, KeysBeforeZeroAreLeftOutWithAWarning) {
  REQUIRE_CASES();
  const TemporaryFolder folder;
  const ProgramResult still = runProgramIn(
      folder, "render " + sharedCase("b23_negative_time").string() + " --preset deferred --size 64x36 -o a.png");
  EXPECT_EQ(still.exitCode, 0) << still.err;
  EXPECT_NE(still.err.find("do not increase from 0"), std::string::npos) << still.err;
}

TEST(Motion, AllAnimationsPlayUnlessOneIsNamed) {
  REQUIRE_CASES();
  const auto heights = [](const std::string& options) {
    const Image layers = layersAt("b45_two_animations", "--time 1.5 " + options);
    const auto row = [&](int from, int to) {
      for (int y = 0; y < layers.height; ++y)
        for (int x = from; x < to; ++x)
          if (valueAt(layers, "depth.Z", x, y) > 0) return y;
      return -1;
    };
    return std::pair(row(0, 160), row(160, 320));
  };
  const auto [left, right] = heights("");
  EXPECT_GT(left, 0);
  EXPECT_EQ(left, right) << "both moved";
  EXPECT_EQ(heights("--animation all"), std::pair(left, right));
  const auto [named, still] = heights("--animation box0Action");
  EXPECT_EQ(named, left);
  EXPECT_GT(still, right + 10) << "the other one is at rest";
  EXPECT_EQ(heights("--animation 1").second, right);
  const TemporaryFolder folder;
  const ProgramResult unknown = runProgramIn(
      folder, "render " + sharedCase("b45_two_animations").string() + " --time 1 --animation hop -o a.png");
  EXPECT_EQ(unknown.exitCode, 2);
  EXPECT_NE(unknown.err.find("box1Action"), std::string::npos) << unknown.err;
}

const std::string kQuickFox =
    " --size 96x54 --set shadow.resolution=64 --set shadow.sky_directions=0 --mirror '*=0.5' ";

TEST(Motion, AnInterruptedSequenceGoesOnToTheSameFiles) {
  const std::filesystem::path fox = testing::sharedScene("fox.glb");
  HALFSILVER_REQUIRE_SCENE(fox);
  const TemporaryFolder folder;
  const std::string render = "render " + fox.string() + kQuickFox + "--fps 12 ";
  const auto expectDone = [&](const std::string& arguments, const std::string& says) {
    const ProgramResult result = runProgramIn(folder, render + arguments);
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.out.find(says), std::string::npos) << result.out;
  };
  expectDone("--frames 8..13 -o a.####.png --layers a.####.exr", "6 frames of 6 drawn");
  expectDone("--frames 8..9 -o b.####.png --layers b.####.exr", "2 frames of 2 drawn");
  std::filesystem::remove(folder / "b.0008.exr");
  expectDone("--frames 8..13 -o b.####.png --layers b.####.exr", "5 frames of 6 drawn");
  expectDone("--frames 8..13 -o b.####.png --layers b.####.exr", "all 6 frames are there");
  for (const char* end : {"0008.png", "0009.png", "0010.png", "0013.png", "0008.exr", "0009.exr", "0010.exr",
                          "0011.exr", "0012.exr", "0013.exr"})
    EXPECT_TRUE(readText(folder / (std::string("a.") + end)) == readText(folder / (std::string("b.") + end))) << end;
  EXPECT_FALSE(readText(folder / "a.0008.png") == readText(folder / "a.0013.png")) << "it moves";
  // Each is what a picture at its time is.
  ASSERT_EQ(runProgramIn(folder, "render " + fox.string() + kQuickFox + "--time 0.75 -o c.png").exitCode, 0);
  EXPECT_TRUE(readText(folder / "a.0009.png") == readText(folder / "c.png"));
  expectDone("--frames 8..8 --overwrite -o b.####.png", "1 frames of 1 drawn");
}

TEST(Motion, WrongSequencesAreRefusedInOneLine) {
  const TemporaryFolder folder;
  for (const char* wrong :
       {"-o a.####.png --frames 3..1", "-o a.####.png --frames -1..1", "-o a.####.png --frames x",
        "-o a.png --frames 0..1", "-o a.####.png --frames 0..1 --fps 0", "-o a.####.png --frames 0..1 --time 1",
        "-o a.png --fps 5", "-o a.####.png --frames 0..1 --stats s.json", "-o a.png --overwrite"}) {
    const ProgramResult result = runProgramIn(folder, std::string("render builtin:sphere --size 16x9 ") + wrong);
    EXPECT_EQ(result.exitCode, 2) << wrong << ": " << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
  EXPECT_TRUE(filesIn(folder).empty());
}

}  // namespace
}  // namespace halfsilver
