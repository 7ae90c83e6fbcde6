#include <gtest/gtest.h>

#include "program.h"

namespace halfsilver {
namespace {

#if HALFSILVER_EXACT

const std::string kQuickTune =
    "tune builtin:sphere --size 64x36 --repeat 2 --set voxels.resolution=64 --set abuffer.resolution=256 "
    "--set search.steps=3 ";

TEST(Tune, WritesAFileThatRenderTakesWithTheFrontInIt) {
  const TemporaryFolder folder;
  const ProgramResult result = runProgramIn(folder, kQuickTune + "-o c.toml");
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.err, "") << "progress or warnings in a pipe";
  EXPECT_EQ(filesIn(folder), (std::vector<std::string>{"c.toml"}));
  // Everything tried is in the table, with the errors of the attribute method; the chosen one has none.
  const std::string row = "kastrati2017 voxels.resolution=64 abuffer.resolution=256 search.steps=3";
  for (const std::string& text : {row, std::string("halfsilver voxels.per_triangle=2"), std::string("  <- chosen\n")})
    EXPECT_NE(result.out.find(text), std::string::npos) << text << " in\n" << result.out;

  const std::string config = readText(folder / "c.toml");
  for (const char* text : {"# ", "builtin:sphere", "64x36", "hit_error", "  <- chosen\n", "\nmethod = \"identity\"\n"})
    EXPECT_NE(config.find(text), std::string::npos) << text << " in\n" << config;
  const ProgramResult picture =
      runProgramIn(folder, "render builtin:sphere --size 64x36 --config c.toml -o a.png --stats s.json");
  ASSERT_EQ(picture.exitCode, 0) << picture.err;
  const auto settings = readJson(folder / "s.json")["settings"];
  EXPECT_EQ(settings["trace.method"], "identity");
  EXPECT_EQ(settings["voxels.resolution"], 64);
  EXPECT_EQ(settings["abuffer.keep"], true) << "only the measurement builds from scratch";
  std::string chosen = config.substr(0, config.find("  <- chosen"));
  chosen = chosen.substr(chosen.rfind('=') + 1);
  EXPECT_EQ(settings["voxels.per_triangle"], std::stod(chosen));
}

TEST(Tune, IfNothingIsAccurateEnoughNothingIsWritten) {
  const TemporaryFolder folder;
  const ProgramResult result =
      runProgramIn(folder, kQuickTune + "-o c.toml --max-error 0 --set trace.method=attributes");
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_TRUE(
      result.err.starts_with("halfsilver: no settings reach --max-error 0: the lowest hit_error measured is 0.0"))
      << result.err;
  EXPECT_NE(result.err.find("kastrati2017 voxels.resolution=64"), std::string::npos) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(filesIn(folder).empty());
}

TEST(Tune, AViewWithoutReflectionsIsRefused) {
  const TemporaryFolder folder;
  const ProgramResult result = runProgramIn(folder, kQuickTune + "-o c.toml --set select.mode=none");
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_NE(result.err.find("builtin:sphere"), std::string::npos) << result.err;
  EXPECT_TRUE(filesIn(folder).empty());
}

#endif

}  // namespace
}  // namespace halfsilver
