#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <halfsilver/io.h>
#include <halfsilver/pose.h>
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

// Both ways of posing.
const std::string kPosings[] = {"--set scene.posing=gpu ", "--set scene.posing=cpu "};

Image layersAt(const std::string& name, const std::string& options) {
  const TemporaryFolder folder;
  const ProgramResult result =
      runProgramIn(folder, "render " + sharedCase(name).string() +
                               " --preset deferred --size 320x180 -o a.png --layers l.exr " + options);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  return result.exitCode == 0 ? readImage(folder / "l.exr").image : Image{};
}

// The layers of an image sequence.
std::vector<Image> framesOf(const std::filesystem::path& scene, const std::string& options,
                            const std::string& how = "--preset deferred --size 320x180 ") {
  const TemporaryFolder folder;
  const ProgramResult result =
      runProgramIn(folder, "render " + scene.string() + " -o a.##.png --layers l.##.exr " + how + options);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  std::vector<Image> frames;
  for (const std::string& name : filesIn(folder))
    if (name.ends_with(".exr")) frames.push_back(readImage(folder / name).image);
  return frames;
}

std::vector<float> planeOf(const Image& image, const std::string& channel) {
  std::vector<float> plane;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) plane.push_back(valueAt(image, channel, x, y));
  return plane;
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
  for (const std::string& posing : kPosings)
    for (const char* name : {"b01_animated_mirror", "b01_unmirrored_by_animation"}) {
      // All but frame 2, at which the cube is flat.
      const std::vector<Image> frames = framesOf(sharedCase(name), posing + "--frames 0..8 --fps 4");
      ASSERT_EQ(frames.size(), 9u);
      for (const int frame : {0, 1, 3, 4, 5, 6, 7, 8})
        EXPECT_NEAR(valueAt(frames[static_cast<std::size_t>(frame)], "depth.Z", 160, 90), 2.5f, 1e-4f)
            << name << ", frame " << frame << ' ' << posing;
    }
}

TEST(Motion, ASkinUnderAMirroredArmatureShowsItsFront) {
  REQUIRE_CASES();
  for (const char* name : {"b02_skin_mirrored_armature", "b02_skin_plain_armature"}) {
    EXPECT_NEAR(depthAtCenter(name, ""), 2.5f, 1e-4f) << name;
    for (const std::string& posing : kPosings)
      EXPECT_NEAR(depthAtCenter(name, posing + "--time 0"), 2.5f, 1e-4f) << name << ' ' << posing;
  }
}

TEST(Motion, WhatIsDegenerateAtRestShowsInALaterPose) {
  REQUIRE_CASES();
  for (const char* name :
       {"b03_scale_from_zero", "b03_morph_from_nothing", "b03_joint_from_zero", "b03_scale_from_zero_alone"})
    for (const std::string& posing : kPosings)
      EXPECT_NEAR(depthAtCenter(name, posing + "--time 1.5"), 2.5f, 1e-4f) << name << ' ' << posing;
  EXPECT_EQ(depthAtCenter("b03_scale_from_zero_alone", ""), 0) << "empty at rest, and a picture all the same";
}

TEST(Motion, AStepHoldsFromTheTimeOfItsKeyOn) {
  REQUIRE_CASES();
  for (const std::string& posing : kPosings) {
    const std::vector<Image> tenths = framesOf(sharedCase("b04_step_tenths"), posing + "--frames 0..10 --fps 10");
    ASSERT_EQ(tenths.size(), 11u);
    const float middle = columnOf(tenths.front());
    const float whole = columnOf(tenths.back()) - middle;
    ASSERT_GT(whole, 40);
    for (std::size_t tenth = 1; tenth < 10; ++tenth)
      EXPECT_NEAR(columnOf(tenths[tenth]) - middle, whole * static_cast<float>(tenth) / 10, 1.5f)
          << tenth << ' ' << posing;
  }
  const float middle = columnOf(layersAt("b04_step_tenths", "--time 0"));
  EXPECT_GT(columnOf(layersAt("b04_step_tenths", "--time 0.1")), middle + 4) << "as text has it";
}

TEST(Motion, TheDurationThatInfoPrintsIsTheLastPose) {
  REQUIRE_CASES();
  for (const char* name : {"b05_slide_0.4", "b05_slide_0.9"}) {
    const TemporaryFolder folder;
    const ProgramResult info = runProgramIn(folder, "info --json " + sharedCase(name).string());
    ASSERT_EQ(info.exitCode, 0) << info.err;
    const std::string end = nlohmann::json::parse(info.out)["animations"][0]["duration"].dump();
    for (const std::string& posing : kPosings)
      EXPECT_GT(columnOf(layersAt(name, posing + "--time " + end)), 200) << name << " at " << end << ' ' << posing;
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
  // From its first valid key, at 0 s, it moves by a meter in a second.
  const float start = columnOf(layersAt("b23_negative_time", "--time 0"));
  EXPECT_NEAR(start, 160, 1);
  for (const std::string& posing : kPosings) {
    const float middle = columnOf(layersAt("b23_negative_time", posing + "--time 0.5")) - start;
    EXPECT_NEAR(middle, 38, 4) << posing;
    EXPECT_NEAR(columnOf(layersAt("b23_negative_time", posing + "--time 1")) - start, 2 * middle, 4) << posing;
  }
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
  EXPECT_EQ(heights("--animation all " + kPosings[1]), std::pair(left, right));
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

TEST(Motion, TheDefaultHitsWhatExactRaysHitInEveryPose) {
  const std::string quick =
      "--size 64x48 --mirror '*=0.5' --set shadow.resolution=64 --set shadow.sky_directions=0 --frames 0..4 --fps 3 ";
  std::size_t hits = 0;
  for (const char* name : {"fox", "rigged_figure", "box_animated", "animated_morph_cube", "milk_truck", "desk_fan"}) {
    const std::filesystem::path scene = testing::sharedScene(std::string(name) + ".glb");
    HALFSILVER_REQUIRE_SCENE(scene);
    const std::vector<Image> frames = framesOf(scene, quick, ""), truth = framesOf(scene, quick, "--preset reference ");
    ASSERT_EQ(frames.size(), 5u);
    ASSERT_EQ(truth.size(), 5u);
    bool moves = false;
    for (std::size_t frame = 0; frame < frames.size(); ++frame) {
      const LayerComparison errors =
          compareLayers(frames[frame], truth[frame], animatedBounds(loadGltf(scene)).all.diagonal());
      EXPECT_EQ(errors.hitError, 0) << name << ", frame " << frame;
      const std::vector<float> distances = planeOf(truth[frame], "hit.T");
      hits +=
          static_cast<std::size_t>(std::count_if(distances.begin(), distances.end(), [](float t) { return t > 0; }));
      moves |= planeOf(frames[frame], "depth.Z") != planeOf(frames.front(), "depth.Z");
    }
    EXPECT_TRUE(moves) << name;
  }
  EXPECT_GT(hits, 500u);
}

TEST(Motion, MethodsThatDrawAFirstFrameAgainKeepItsMotionVectors) {
  const std::filesystem::path fox = testing::sharedScene("fox.glb");
  HALFSILVER_REQUIRE_SCENE(fox);
  const std::string frame = kQuickFox + "--frames 3..3 ";
  const Image again = framesOf(fox, frame, "--preset kastrati2017 ").at(0), truth = framesOf(fox, frame, "").at(0);
  const std::vector<float> motion = planeOf(truth, "motion.X");
  EXPECT_EQ(planeOf(again, "motion.X"), motion);
  EXPECT_GT(std::count_if(motion.begin(), motion.end(), [](float x) { return std::abs(x) > 0.05f; }), 50);
}

// The cube that is nothing at rest, elsewhere and without a camera.
TEST(Motion, WhatIsNothingAtRestIsFramedAndPreciseFarAway) {
  REQUIRE_CASES();
  nlohmann::json file = readJson(sharedCase("b03_scale_from_zero_alone"));
  file["nodes"][1]["translation"] = {1e6, 0, 0};
  file["scenes"][0]["nodes"] = {1};
  const TemporaryFolder folder;
  std::ofstream(folder / "far.gltf") << file;
  const std::string deferred = "render far.gltf --preset deferred --size 320x180 -o a.png --layers l.exr ";
  for (const std::string& posing : kPosings) {
    ASSERT_EQ(runProgramIn(folder, deferred + "--time 1.5 " + posing).exitCode, 0);
    const Image framed = readImage(folder / "l.exr").image;
    const std::vector<float> depth = planeOf(framed, "depth.Z");
    const auto covered = std::count_if(depth.begin(), depth.end(), [](float z) { return z > 0; });
    EXPECT_GT(covered, 1000);
    EXPECT_LT(covered, 30000);
    ASSERT_EQ(runProgramIn(folder, deferred + "--time 1.5 --eye 1000000,0,3 --target 1000000,0,0 " + posing).exitCode,
              0);
    EXPECT_NEAR(valueAt(readImage(folder / "l.exr").image, "depth.Z", 160, 90), 2.5f, 1e-5f) << posing;
    const std::vector<float> left = planeOf(readImage(folder / "l.exr").image, "depth.Z");
    std::size_t mirrored = 0;
    for (std::size_t y = 0; y < 180; ++y)
      for (std::size_t x = 0; x < 160; ++x) mirrored += (left[320 * y + x] > 0) == (left[320 * y + 319 - x] > 0);
    EXPECT_EQ(mirrored, 180u * 160u) << "its edges are where they belong " << posing;
  }
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

// Two triangles and the camera before them travel 6,400 km in ten seconds; a third stays behind.
std::string writeTraveler(const TemporaryFolder& folder) {
  const float numbers[] = {-1, -1, 0, 1, -1, 0, 0, 1, 0, 0, 10, 0, 0, 0, 6.4e6f, 1.25f, -7};
  std::ofstream(folder / "far.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(numbers), static_cast<std::streamsize>(sizeof(numbers)));
  std::ofstream(folder / "far.gltf") << R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 3]}],
    "nodes": [{"mesh": 0, "children": [1, 2]}, {"camera": 0, "translation": [0, 0, 4]},
              {"mesh": 0, "translation": [0.6, 0.3, -2], "rotation": [0, 0, 0.3826834, 0.9238795]},
              {"mesh": 0, "translation": [0, 0, -9]}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "buffers": [{"uri": "far.bin", "byteLength": 68}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 8},
                    {"buffer": 0, "byteOffset": 44, "byteLength": 24}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                   "min": [-1, -1, 0], "max": [1, 1, 0]},
                  {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [10]},
                  {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"}],
    "animations": [{"samplers": [{"input": 1, "output": 2}],
                    "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}]})";
  return (folder / "far.gltf").string();
}

TEST(Motion, WhatTravelsFarWithItsCameraKeepsItsShape) {
  const TemporaryFolder folder;
  const std::string scene = writeTraveler(folder);
  for (const std::string& posing : kPosings) {
    SCOPED_TRACE(posing);
    const std::vector<Image> frames = framesOf(scene, posing + "--frames 1..9 --fps 1");
    ASSERT_EQ(frames.size(), 9u);
    // One second later all that stayed behind is out of sight.
    const std::vector<float> first = planeOf(frames.front(), "depth.Z");
    EXPECT_GT(std::count_if(first.begin(), first.end(), [](float depth) { return depth > 3.9f; }), 5000);
    for (const Image& frame : frames) {
      const std::vector<float> depth = planeOf(frame, "depth.Z");
      std::size_t unlike = 0;
      for (std::size_t i = 0; i < depth.size(); ++i) unlike += std::abs(depth[i] - first[i]) > 1e-4f;
      EXPECT_LE(unlike, 4u);  // centers on an edge
    }
  }
  const ProgramResult still = runProgramIn(
      folder, "render " + scene + " --preset deferred --size 320x180 --time 7.7 " + "-o a.png --layers a.exr");
  ASSERT_EQ(still.exitCode, 0) << still.err;
  const std::vector<float> depth = planeOf(readImage(folder / "a.exr").image, "depth.Z"),
                           first = planeOf(framesOf(scene, "--frames 1..1 --fps 1").front(), "depth.Z");
  std::size_t unlike = 0;
  for (std::size_t i = 0; i < depth.size(); ++i) unlike += std::abs(depth[i] - first[i]) > 1e-4f;
  EXPECT_LE(unlike, 4u);
}

}  // namespace
}  // namespace halfsilver
