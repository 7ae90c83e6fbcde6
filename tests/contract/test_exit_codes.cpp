#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "program.h"

namespace halfsilver {
namespace {

// Expects the exit code, one line on stderr that contains `mention`, nothing on stdout, and no new file.
void expectRefused(const TemporaryFolder& folder, const std::string& arguments, int exitCode,
                   const std::string& mention = "", const std::string& environment = "") {
  SCOPED_TRACE(arguments);
  const std::vector<std::string> before = filesIn(folder);
  const ProgramResult result = runProgramIn(folder, arguments, environment);
  EXPECT_EQ(result.exitCode, exitCode) << result.err;
  EXPECT_TRUE(result.err.starts_with("halfsilver: ")) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_TRUE(result.err.ends_with('\n')) << result.err;
  EXPECT_NE(result.err.find(mention), std::string::npos) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(filesIn(folder), before);
}

TEST(ExitCodes, HelpAndVersionAreFine) {
  const TemporaryFolder folder;
  for (const char* arguments : {"--help", "--version", "render --help", "tune --help", "compare --help", "presets"}) {
    const ProgramResult result = runProgramIn(folder, arguments);
    EXPECT_EQ(result.exitCode, 0) << arguments;
    EXPECT_NE(result.out, "") << arguments;
    EXPECT_EQ(result.err, "") << arguments;
  }
}

TEST(ExitCodes, WrongUsageIs2) {
  const TemporaryFolder folder;
  expectRefused(folder, "", 2);
  expectRefused(folder, "paint", 2);
  expectRefused(folder, "render", 2);
  expectRefused(folder, "render builtin:sphere", 2, "output");
  expectRefused(folder, "render builtin:sphere -o a.png --wrong", 2, "wrong");
  expectRefused(folder, "render builtin:sphere -o a.bmp", 2, "a.bmp");
  expectRefused(folder, "render builtin:sphere -o a.png --layers b.png", 2, "b.png");
  expectRefused(folder, "render builtin:sphere -o a.exr --layers ./a.exr", 2, "a.exr");
  expectRefused(folder, "render builtin:sphere -o a.png --context vulkan", 2, "vulkan");
  expectRefused(folder, "render builtin:sphere -o a.png --preset nosuch", 2, "kastrati2017");
  expectRefused(folder, "render builtin:sphere -o a.png --preset hu2014 --config a.toml", 2, "--config");
  expectRefused(folder, "render builtin:sphere -o a.png --set voxels.resolution", 2, "voxels.resolution");
  for (const char* size : {"0x0", "99999x1", "1x99999", "-5x5", "640", "axb", "''"})
    expectRefused(folder, std::string("render builtin:sphere -o a.png --size ") + size, 2, "size");
  for (const char* bounces : {"0", "17", "x", "1.5"})
    expectRefused(folder, std::string("render builtin:sphere -o a.png --bounces ") + bounces, 2, "bounces");
  for (const char* mirror : {"floor", "floor=2", "floor=-1", "floor=nan", "=1"})
    expectRefused(folder, std::string("render builtin:sphere -o a.png --mirror ") + mirror, 2, "--mirror");
  for (const char* light : {"sun", "point:0,0,0", "sphere:0,0,0:-1:1,1,1"})
    for (const char* command : {"render builtin:sphere -o a.png --light ", "info builtin:sphere --light "})
      expectRefused(folder, std::string(command) + light, 2, "--light");
  expectRefused(folder, "render builtin:sphere -o a.png --repeat 0", 2, "repeat");
  expectRefused(folder, "render builtin:sphere -o a.png --threads 0", 2, "threads");
}

TEST(ExitCodes, WrongBudgetsAre2) {
  const TemporaryFolder folder;
  for (const char* option : {"--budget-ms", "--budget-mb"})
    for (const char* value : {"0", "-1", "nan", "x", ""})
      expectRefused(folder, std::string("render builtin:sphere -o a.png ") + option + " " + value, 2, option);
}

TEST(ExitCodes, BudgetsThatAnEffectCannotKeepAre2) {
  const TemporaryFolder folder;
  expectRefused(folder, "render builtin:sphere -o a.png --preset path --budget-mb 4", 2, "--budget-mb");
  expectRefused(folder, "render builtin:sphere -o a.png --preset layers --budget-ms 4", 2, "--budget-ms");
  expectRefused(folder, "render builtin:sphere -o a.png --preset path --progress-every 1 --budget-ms 4", 2,
                "--budget-ms");
}

TEST(ExitCodes, WrongTuningIs2) {
  const TemporaryFolder folder;
  const std::string tune = "tune builtin:sphere -o c.toml ";
  for (const char* error : {"-1", "1.5", "nan", "x"})
    expectRefused(folder, tune + "--max-error " + error, 2, "--max-error");
  expectRefused(folder, "tune", 2, "SCENE");
  expectRefused(folder, tune + "--size 0x0", 2, "size");
  expectRefused(folder, tune + "--repeat 0", 2, "repeat");
  expectRefused(folder, tune + "--preset nosuch", 2, "kastrati2017");
  expectRefused(folder, tune + "--set trace.method=exact", 2, "trace.method");
}

TEST(ExitCodes, UnknownNamesInTheSceneAre2AndListTheKnown) {
  const TemporaryFolder folder;
  writeWall(folder);
  expectRefused(folder, "render wall.gltf -o a.png --camera far", 2, "near");
  expectRefused(folder, "render wall.gltf -o a.png --camera 7", 2, "near");
  expectRefused(folder, "render wall.gltf -o a.png --mirror glass=1", 2, "paint");
  expectRefused(folder, "render wall.gltf -o a.png --eye 0,0,5", 2, "--target");
  expectRefused(folder, "render wall.gltf -o a.png --eye 0,0,5 --target 0,0,5", 2, "--eye");
  expectRefused(folder, "render wall.gltf -o a.png --eye 0,0 --target 0,0,5", 2, "--eye");
  expectRefused(folder, "render wall.gltf -o a.png --camera near --eye 1,0,0 --target 0,0,5", 2, "--camera");
  for (const char* fov : {"0", "180", "-20", "nan"})
    expectRefused(folder, std::string("render wall.gltf -o a.png --fov ") + fov, 2, "--fov");
}

TEST(ExitCodes, BadScenesAre3) {
  const TemporaryFolder folder;
  std::ofstream(folder / "garbage.glb") << "glTF? no";
  std::ofstream(folder / "empty.gltf");
  expectRefused(folder, "render missing.glb -o a.png", 3, "missing.glb");
  expectRefused(folder, "render garbage.glb -o a.png", 3, "garbage.glb");
  expectRefused(folder, "render empty.gltf -o a.png", 3, "empty.gltf");
  expectRefused(folder, "render . -o a.png", 3);
  expectRefused(folder, "render builtin:nosuch -o a.png", 3, "atrium");
  expectRefused(folder, "tune builtin:nosuch -o c.toml", 3, "atrium");
  expectRefused(folder, "tune missing.glb -o c.toml", 3, "missing.glb");
  expectRefused(folder, "info garbage.glb", 3, "garbage.glb");
  expectRefused(folder, "info missing.glb --json", 3, "missing.glb");
}

TEST(ExitCodes, BadConfigurationIs3AndNamesTheLine) {
  const TemporaryFolder folder;
  std::ofstream(folder / "bad.toml") << "[voxels]\nresolution = 32\nresolutoin = 3\n";
  std::ofstream(folder / "syntax.toml") << "[voxels\n";
  const std::string render = "render builtin:sphere -o a.png ";
  expectRefused(folder, render + "--config bad.toml", 3, "bad.toml:3: ");
  expectRefused(folder, render + "--config syntax.toml", 3, "syntax.toml:1: ");
  expectRefused(folder, render + "--config missing.toml", 3, "missing.toml");
  expectRefused(folder, render + "--set nosuch.key=1", 3, "nosuch.key");
  expectRefused(folder, render + "--set voxels.resolution=0", 3, "voxels.resolution");
  expectRefused(folder, render + "--set select.mode=some", 3, "reflective");
  expectRefused(folder, "tune builtin:sphere -o c.toml --config bad.toml", 3, "bad.toml:3: ");
  expectRefused(folder, "tune builtin:sphere -o c.toml --set nosuch.key=1", 3, "nosuch.key");
}

TEST(ExitCodes, BadImagesAre3) {
  const TemporaryFolder folder;
  std::ofstream(folder / "garbage.exr") << "no sky here";
  expectRefused(folder, "render builtin:sphere -o a.png --sky missing.hdr", 3, "missing.hdr");
  expectRefused(folder, "render builtin:sphere -o a.png --sky garbage.exr", 3, "garbage.exr");
  expectRefused(folder, "compare garbage.exr garbage.exr", 3, "garbage.exr");
  expectRefused(folder, "compare missing.png garbage.exr --json", 3, "missing.png");
}

TEST(ExitCodes, WhatCannotBeWrittenIs1BeforeAnyWork) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "folder.png");
  std::ofstream(folder / "file") << "x";
  // A scene that is not there: the outputs are checked first.
  expectRefused(folder, "render missing.glb -o nowhere/a.png", 1, "nowhere/a.png");
  expectRefused(folder, "render missing.glb -o folder.png", 1, "folder.png");
  expectRefused(folder, "render missing.glb -o a.png --stats file/s.json", 1, "file/s.json");
  expectRefused(folder, "render missing.glb -o a.png --layers nowhere/l.exr", 1, "nowhere/l.exr");
  expectRefused(folder, "tune missing.glb -o nowhere/c.toml", 1, "nowhere/c.toml");
}

TEST(ExitCodes, NoContextIs4) {
  const TemporaryFolder folder;
  writeWall(folder);
  expectRefused(folder, "render wall.gltf -o a.png --context egl", 4, "", "__EGL_VENDOR_LIBRARY_FILENAMES=/dev/null");
}

}  // namespace
}  // namespace halfsilver
