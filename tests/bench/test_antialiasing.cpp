#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "bench/harness/flicker.h"
#include "bench/modes/antialiasing/report.h"
#include "contract/program.h"

namespace halfsilver::bench {
namespace {

AntialiasingPoint pointOf(const char* scene, const char* antialiasing, double flicker) {
  AntialiasingPoint point;
  point.scene.file = scene;
  point.preset = antialiasing;
  point.flickerMean = flicker;
  return point;
}

TEST(Antialiasing, WhatIsLeftOfFlickerIsAShareOfThatOfTheSameScene) {
  const std::vector<AntialiasingPoint> points = {pointOf("a", kNone, 0.5), pointOf("b", kNone, 0.2),
                                                 pointOf("b", kTemporal, 0.05), pointOf("c", kTemporal, 0.1),
                                                 pointOf("d", kNone, 0)};
  EXPECT_DOUBLE_EQ(flickerLeft(points, points[2]).value(), 0.25);
  EXPECT_DOUBLE_EQ(flickerLeft(points, points[0]).value(), 1);
  EXPECT_FALSE(flickerLeft(points, points[3])) << "nothing to compare with";
  EXPECT_FALSE(flickerLeft(points, points[4])) << "nothing flickers";
}

TEST(Flicker, AllPixelsCountIfAsked) {
  const auto row = [](float gray) {
    Image image{10, 1, {"R", "G", "B", "selected.Y", "hit.T"}, {}};
    for (int i = 0; i < 10; ++i) image.data.insert(image.data.end(), {gray, gray, gray, 0, -1});
    return image;
  };
  FlickerMeter all(FlickerMeter::Pixels::all), traced;
  for (FlickerMeter* meter : {&all, &traced})
    for (const float gray : {0.0f, 0.5f}) meter->add(row(gray), row(0));
  EXPECT_EQ(all.result().pixels, 10u);
  EXPECT_NEAR(all.result().mean, 0.5, 1e-6);
  EXPECT_EQ(traced.result().pixels, 0u);
}

TEST(BenchAntialiasing, ShowsThatFlickerAndErrorFallAndMeasuresOnce) {
  const TemporaryFolder folder;
  const std::string command = "antialiasing builtin:rods -o DIR --quick --size 96x64";
  const ProgramResult result = runProgramIn(folder, command);
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const nlohmann::json points = readJson(folder / "DIR/antialiasing.json")["points"];
  ASSERT_EQ(points.size(), 2u);
  const nlohmann::json &none = points[0], &temporal = points[1];
  ASSERT_EQ(none["preset"], "none");
  ASSERT_EQ(temporal["preset"], "temporal");
  EXPECT_GT(none["flicker_mean"].get<double>(), 1e-4);
  EXPECT_LT(temporal["flicker_mean"].get<double>(), none["flicker_mean"].get<double>());
  EXPECT_LT(temporal["rmse"].get<double>(), none["rmse"].get<double>());
  const std::vector<std::string> files = filesIn(folder);
  for (const char* name : {"DIR/antialiasing.csv", "DIR/index.html", "DIR/builtin-rods-none.png",
                           "DIR/builtin-rods-temporal.png", "DIR/builtin-rods-truth.png"})
    EXPECT_TRUE(std::binary_search(files.begin(), files.end(), name)) << name;
  const std::string before = readText(folder / "DIR/antialiasing.json");
  ASSERT_EQ(runProgramIn(folder, command).exitCode, 0);
  EXPECT_EQ(readText(folder / "DIR/antialiasing.json"), before);
}

}  // namespace
}  // namespace halfsilver::bench
