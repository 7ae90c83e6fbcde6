#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include "apps/tune_candidates.h"
#include "apps/tune_report.h"

namespace halfsilver {
namespace {

std::vector<Candidate> all(const std::vector<Ladder>& ladders) {
  std::vector<Candidate> result;
  for (const Ladder& ladder : ladders) result.insert(result.end(), ladder.begin(), ladder.end());
  return result;
}

std::size_t count(const std::vector<Candidate>& candidates, const std::string& method) {
  return static_cast<std::size_t>(std::count_if(candidates.begin(), candidates.end(),
                                                [&](const Candidate& c) { return c.settings.trace.method == method; }));
}

TEST(TuneLadders, ClimbOneSettingOfEachMethod) {
  const std::vector<Ladder> ladders = tuneLadders({});
  const std::vector<Candidate> candidates = all(ladders);
  EXPECT_GE(count(candidates, "identity"), 5u);
  EXPECT_GE(count(candidates, "attributes"), 20u);
  std::set<std::string> texts;
  for (const Candidate& candidate : candidates) texts.insert(candidate.text());
  EXPECT_EQ(texts.size(), candidates.size());
  EXPECT_TRUE(texts.contains("halfsilver voxels.per_triangle=16"));
  EXPECT_TRUE(texts.contains("kastrati2017 voxels.resolution=64 abuffer.resolution=1024 search.steps=3"));
  for (const Ladder& ladder : ladders)
    for (std::size_t i = 1; i < ladder.size(); ++i) {
      const Settings &small = ladder[i - 1].settings, &large = ladder[i].settings;
      Settings same = small;
      same.identity.voxelsPerTriangle = large.identity.voxelsPerTriangle;
      same.abuffer.resolution = large.abuffer.resolution;
      EXPECT_EQ(same, large) << ladder[i].text();
      EXPECT_TRUE(small.identity.voxelsPerTriangle < large.identity.voxelsPerTriangle ||
                  small.abuffer.resolution < large.abuffer.resolution);
    }
}

TEST(TuneLadders, TheBaseDecidesWhatIsDrawnAndOverridesAreKept) {
  ViewRequest request;
  request.preset = "hu2014";  // all pixels, with its own structure
  request.set = {"search.steps=3", "voxels.resolution=100", "image.exposure=1"};
  request.bounces = 2;
  const std::vector<Candidate> candidates = all(tuneLadders(request));
  // Steps and voxels are given: four sizes of the A-buffer are left.
  EXPECT_EQ(count(candidates, "attributes"), 4u);
  EXPECT_GE(count(candidates, "identity"), 5u);
  for (const Candidate& candidate : candidates) {
    EXPECT_EQ(candidate.settings.select.mode, SelectMode::all);
    EXPECT_EQ(candidate.settings.trace.bounces, 2);
    EXPECT_EQ(candidate.settings.image.exposure, 1);
    EXPECT_EQ(candidate.settings.voxels.resolution, 100);
    EXPECT_EQ(candidate.settings.attributes.buffers, Buffers::single);
  }
}

TEST(TuneLadders, AMethodCanBeLeftOut) {
  ViewRequest request;
  request.set = {"trace.method=attributes"};
  EXPECT_EQ(count(all(tuneLadders(request)), "identity"), 0u);
  EXPECT_GT(count(all(tuneLadders(request)), "attributes"), 0u);
  request.set = {"trace.method=identity", "voxels.per_triangle=3"};
  EXPECT_EQ(all(tuneLadders(request)).size(), 1u);
  request.set = {"trace.method=exact"};
  EXPECT_THROW(tuneLadders(request), Error);
}

// Of three candidates the second is chosen, the third is beaten by the first.
TuneReport madeUpReport() {
  TuneReport report;
  report.view = "a\nvoxels = 3\xff.glb";
  report.device = {"vendor", "device \"x\"", "4.5", false};
  report.context = "egl";
  report.width = 64;
  report.height = 36;
  report.triangles = 7;
  report.coverage = 0.125;
  report.maxError = 0.0005;
  ViewRequest request;
  request.set = {"select.fraction=0.3"};
  const std::vector<Candidate> candidates = all(tuneLadders(request));
  report.points = {{candidates[0], {10, 2000000, 0.001}, 3},
                   {candidates[1], {20, 3000000, 0}, 3},
                   {candidates.back(), {40, 4000000, 0.25}, 1}};
  report.skipped = {"something: does not fit"};
  report.choice = 1;
  return report;
}

TEST(TuneReport, TableMarksTheFrontAndTheChoice) {
  const std::string table = tuneTable(madeUpReport());
  for (const char* text : {"64x36", "12.50 %", "7 triangles", "device \"x\"", "skipped: something: does not fit\n",
                           "*     10.000       2.000   0.001000     3  halfsilver voxels.per_triangle=2\n",
                           "*     20.000       3.000   0.000000     3  halfsilver voxels.per_triangle=4  <- chosen\n",
                           "      40.000       4.000   0.250000     1  burger2007 "})
    EXPECT_NE(table.find(text), std::string::npos) << text << " in\n" << table;
}

TEST(TuneReport, ConfigurationIsTheChosenSettingsAndTheFront) {
  const TuneReport report = madeUpReport();
  const std::string text = tuneConfig(report);
  Settings settings;
  ASSERT_NO_THROW(applySettingsText(settings, text, "tuned.toml")) << text;
  EXPECT_EQ(settings, report.points[1].candidate.settings);
  EXPECT_NE(settings, Settings());
  for (const char* part : {"# ", "0.0005", "64x36", "OpenGL 4.5", "halfsilver voxels.per_triangle=2\n",
                           "halfsilver voxels.per_triangle=4  <- chosen\n", "\nper_triangle = 4\n",
                           "\nmethod = \"identity\"\n", "\nfraction = 0.3\n"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  EXPECT_EQ(text.find("burger2007"), std::string::npos) << "not on the front";
}

}  // namespace
}  // namespace halfsilver
