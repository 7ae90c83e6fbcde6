// The built-in scenes against pictures that a person has approved. Three tolerances: how far one pixel may be off, how
// many may be off by more than a little, and the root mean square; drivers differ in the last bits of filtering.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

#include <halfsilver/io.h>
#include "contract/program.h"

namespace halfsilver {
namespace {

struct Golden {
  const char* scene;
  const char* size;
};

class GoldenTest : public ::testing::TestWithParam<Golden> {};

constexpr double kLittle = 8.0 / 255.0;
constexpr double kMaxFailing = 0.002;  // fraction of values that may be off by more than that
constexpr double kWorst = 0.6;         // an edge that falls on the other side of a pixel's center
constexpr double kRmse = 0.006;

TEST_P(GoldenTest, LooksAsItDid) {
  const TemporaryFolder folder;
  const std::string scene = GetParam().scene;
  const ProgramResult run = runProgramIn(
      folder, "render builtin:" + scene + " --preset halfsilver --size " + GetParam().size + " -o " + scene + ".png");
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const ImageFile picture = readImage(folder.path() / (scene + ".png"));
  const ImageFile golden =
      readImage(std::filesystem::path(HALFSILVER_SOURCE_DIR) / "tests/images/golden" / (scene + ".png"));
  ASSERT_EQ(picture.image.data.size(), golden.image.data.size());

  // Not trivial: many colors, dark and bright.
  std::set<int> levels;
  for (const float value : picture.image.data) levels.insert(static_cast<int>(std::lround(value * 255)));
  EXPECT_GT(levels.size(), 150u);

  std::size_t failing = 0;
  for (std::size_t i = 0; i < picture.image.data.size(); ++i)
    if (std::abs(picture.image.data[i] - golden.image.data[i]) > static_cast<float>(kLittle)) ++failing;
  EXPECT_LE(static_cast<double>(failing), kMaxFailing * static_cast<double>(picture.image.data.size()));
  const Comparison comparison = compareImages(picture, golden);
  EXPECT_LE(comparison.maxError, kWorst);
  EXPECT_LE(comparison.rmse, kRmse);
}

INSTANTIATE_TEST_SUITE_P(Builtin, GoldenTest,
                         ::testing::Values(Golden{"sphere", "192x108"}, Golden{"teapot", "192x108"},
                                           Golden{"atrium", "480x270"}),
                         [](const auto& golden) { return std::string(golden.param.scene); });

}  // namespace
}  // namespace halfsilver
