#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include <halfsilver/builtin.h>
#include "bench/harness/flicker.h"
#include "bench/modes/stability/report.h"
#include "contract/program.h"

namespace halfsilver::bench {
namespace {

// A row of traced gray pixels, all hit.
Image row(int pixels, float gray) {
  Image image{pixels, 1, {"R", "G", "B", "selected.Y", "hit.T"}, {}};
  for (int i = 0; i < pixels; ++i) image.data.insert(image.data.end(), {gray, gray, gray, 1, 2});
  return image;
}

float& at(Image& image, std::size_t pixel, std::size_t channel) { return image.data[pixel * 5 + channel]; }

TEST(Flicker, WhatTheReferenceDoesIsNoFlicker) {
  FlickerMeter meter;
  for (const float gray : {0.2f, 0.7f, 0.1f}) meter.add(row(100, gray), row(100, gray));
  const Flicker flicker = meter.result();
  EXPECT_EQ(flicker.pixels, 100u);
  EXPECT_EQ(flicker.steps, 2u);
  EXPECT_EQ(flicker.identical, 2u);
  EXPECT_EQ(flicker.mean, 0);
  EXPECT_EQ(flicker.percentile99, 0);
  EXPECT_EQ(flicker.hits, 0);
}

TEST(Flicker, AConstantErrorIsNoFlicker) {
  FlickerMeter meter;
  for (int i = 0; i < 3; ++i) meter.add(row(10, 0.9f), row(10, 0.1f));
  EXPECT_EQ(meter.result().mean, 0);
  EXPECT_EQ(meter.result().identical, 2u);
}

TEST(Flicker, CountsTheExcessOnly) {
  FlickerMeter meter;
  meter.add(row(100, 0.0f), row(100, 0.0f));
  // The scene gets brighter by 0.1; two pixels by 0.6, of which one in green only.
  Image frame = row(100, 0.1f);
  for (std::size_t c = 0; c < 3; ++c) at(frame, 3, c) = 0.6f;
  at(frame, 8, 1) = 0.6f;
  meter.add(frame, row(100, 0.1f));
  const Flicker flicker = meter.result();
  EXPECT_NEAR(flicker.mean, 2 * 0.5 / 100, 1e-6);
  EXPECT_NEAR(flicker.percentile99, 0.5, 1e-6);
  EXPECT_EQ(flicker.identical, 0u);
  EXPECT_EQ(flicker.hits, 0);
}

TEST(Flicker, DisplaysClip) {
  FlickerMeter meter;
  meter.add(row(4, 5.0f), row(4, 1.0f));
  meter.add(row(4, 9.0f), row(4, 1.0f));
  EXPECT_EQ(meter.result().mean, 0);
}

TEST(Flicker, HitsThatComeAndGo) {
  FlickerMeter meter;
  Image missed = row(50, 0.5f);
  at(missed, 7, 4) = -1;
  meter.add(row(50, 0.5f), row(50, 0.5f));
  meter.add(missed, row(50, 0.5f));
  meter.add(missed, missed);  // the reference follows late: not the method's fault
  EXPECT_NEAR(meter.result().hits, 1.0 / 100, 1e-12);
}

TEST(Flicker, PixelsThatAreNotTracedDoNotCount) {
  FlickerMeter meter;
  Image before = row(2, 0.0f), after = row(2, 1.0f);
  for (Image* image : {&before, &after}) at(*image, 0, 3) = 0;
  meter.add(before, before);
  meter.add(after, before);
  EXPECT_EQ(meter.result().pixels, 1u);
  EXPECT_EQ(meter.result().mean, 1);
}

TEST(Stability, WhoSurvives) {
  StabilityResult good;
  good.worstHitError = 0.0005;
  good.repeatsExactly = true;
  EXPECT_TRUE(survives(good));
  const std::vector<std::function<void(StabilityResult&)>> faults = {
      [](StabilityResult& r) { r.worstHitError = 0.00051; }, [](StabilityResult& r) { r.overflow = 1e-6; },
      [](StabilityResult& r) { r.lostFragments = 1; },       [](StabilityResult& r) { r.flicker99 = 0.001; },
      [](StabilityResult& r) { r.flickerHits = 0.0002; },    [](StabilityResult& r) { r.repeatsExactly = false; }};
  for (const auto& fault : faults) {
    StabilityResult bad = good;
    fault(bad);
    EXPECT_FALSE(survives(bad)) << nlohmann::ordered_json(bad);
  }
}

// The default preset passes every failure scene, still and in motion.
TEST(BenchStability, TheDefaultSurvivesAll) {
  const TemporaryFolder folder;
  const ProgramResult result = runProgramIn(folder, "stability -o DIR --quick --size 96x64 --method halfsilver");
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const nlohmann::json record = readJson(folder / "DIR/stability.json");
  ASSERT_EQ(record["points"].size(), failureScenes().size());
  for (const auto& json : record["points"]) {
    const auto point = fromJson<StabilityPoint>(json);
    EXPECT_TRUE(survives(point)) << json;
    EXPECT_GT(point.rays, 2000u) << point.scene.file;
    EXPECT_EQ(point.steps, 3u);
  }
  const std::vector<std::string> files = filesIn(folder);
  for (const char* name : {"DIR/index.html", "DIR/stability.csv", "DIR/builtin-rods-reference.png"})
    EXPECT_TRUE(std::binary_search(files.begin(), files.end(), name)) << name;
}

TEST(BenchStability, WhatFailsIsSaid) {
  const TemporaryFolder folder;
  const ProgramResult result =
      runProgramIn(folder, "stability builtin:growing -o DIR --quick --size 96x64 --method kastrati2017");
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const auto point = fromJson<StabilityPoint>(readJson(folder / "DIR/stability.json")["points"][0]);
  EXPECT_FALSE(survives(point));
  EXPECT_GT(point.lostFragments, 0u);
  EXPECT_NE(readText(folder / "DIR/index.html").find("overflow"), std::string::npos);
  EXPECT_EQ(runProgramIn(folder, "stability -o DIR --method nonesuch").exitCode, 2);
}

}  // namespace
}  // namespace halfsilver::bench
