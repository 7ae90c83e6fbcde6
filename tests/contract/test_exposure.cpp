#include <gtest/gtest.h>

#include <filesystem>

#include "program.h"
#include "shared_scenes.h"

namespace halfsilver {
namespace {

double shareOfWhite(const Image& picture) {
  std::size_t white = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      white += valueAt(picture, "R", x, y) == 1 && valueAt(picture, "G", x, y) == 1 && valueAt(picture, "B", x, y) == 1;
  return static_cast<double>(white) / static_cast<double>(picture.pixelCount());
}

class Exposure : public ::testing::Test {
 protected:
  // A lamp of 54,351 candela over a floor.
  ProgramResult render(const std::string& options) {
    return runProgramIn(folder_, "render '" + lamp_.string() + "' -o lamp.png --size 160x90 " + options);
  }
  double white() { return shareOfWhite(readImage(folder_.path() / "lamp.png").image); }

  const std::filesystem::path lamp_ =
      halfsilver::testing::sharedScene("").parent_path().parent_path() / "cases" / "c24_lamp.gltf";
  TemporaryFolder folder_;
};

TEST_F(Exposure, AWhitePictureGivesAHint) {
  HALFSILVER_REQUIRE_SCENE(lamp_);
  const ProgramResult result = render("");
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_NE(result.err.find("of the picture is white"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("--exposure"), std::string::npos);
  EXPECT_GT(white(), 0.5);
}

TEST_F(Exposure, IsFoundByThePicture) {
  HALFSILVER_REQUIRE_SCENE(lamp_);
  const ProgramResult result = render("--exposure auto --stats stats.json");
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.err.find("is white"), std::string::npos) << result.err;
  EXPECT_LT(white(), 0.1);
  EXPECT_LT(readJson(folder_.path() / "stats.json")["settings"]["image.exposure"], -5);
}

TEST_F(Exposure, IsTheSettingIfItIsANumber) {
  HALFSILVER_REQUIRE_SCENE(lamp_);
  ASSERT_EQ(render("--exposure -9 --stats stats.json").exitCode, 0);
  EXPECT_EQ(readJson(folder_.path() / "stats.json")["settings"]["image.exposure"], -9);
  const std::string picture = readText(folder_.path() / "lamp.png");
  ASSERT_EQ(render("--set image.exposure=-9").exitCode, 0);
  EXPECT_EQ(readText(folder_.path() / "lamp.png"), picture);
  for (const char* nonsense : {"bright", "21", "1x"}) {
    const ProgramResult result = render(std::string("--exposure ") + nonsense);
    EXPECT_EQ(result.exitCode, 2) << nonsense << result.err;
  }
}

}  // namespace
}  // namespace halfsilver
