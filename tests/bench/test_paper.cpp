#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "bench/modes/paper/report.h"
#include "contract/program.h"

namespace halfsilver::bench {
namespace {

double traceOf(const PaperPoint& point) { return point.times.trace.median; }

// A table of two rows and one column, of which the second row is half the first in the paper and a quarter here.
struct Published {
  std::vector<Paper> papers;
  std::vector<PaperPoint> points;

  Published() {
    Paper paper{"some2001", "Some One, 2001", "a machine", {8, 6}, {}, {"a figure"}};
    paper.tables.push_back({"Table 1", "Times", {milliseconds("trace", traceOf)}, {}});
    for (const auto& [label, value] : {std::pair("full", std::optional(40.0)), {"half", 20.0}, {"ours", {}}}) {
      PublishedRow row;
      row.label = label;
      row.scene = "sphere";
      row.values = {value};
      row.base = 0;
      paper.tables[0].rows.push_back(std::move(row));
    }
    papers.push_back(paper);
    points.resize(3);
    points[0].times.trace.median = 8;
    points[1].times.trace.median = 2;
    points[2].times.trace.median = 4;
    for (PaperPoint& point : points) point.size = {8, 6};
  }
};

TEST(BenchPaper, RatiosAreTakenWithinATable) {
  const Published published;
  const Table table = paperCsv(published.papers, published.points);
  ASSERT_EQ(table.rows.size(), 3u);
  const auto tail = [&](std::size_t row) {
    return std::vector<std::string>(table.rows[row].begin() + 5, table.rows[row].end());
  };
  EXPECT_EQ(tail(0), (std::vector<std::string>{"40.0", "8.00", "", ""}));
  EXPECT_EQ(tail(1), (std::vector<std::string>{"20.0", "2.00", "0.500", "0.250"}));
  EXPECT_EQ(tail(2), (std::vector<std::string>{"", "4.00", "", "0.500"}));
  EXPECT_EQ(paperSummary(published.papers, published.points).rows.size(), 2u);
}

TEST(BenchPaper, ThePageSaysWhatIsMissing) {
  const Published published;
  const halfsilver::TemporaryFolder folder;
  const std::string body =
      paperBody(published.papers, {"sphere: another"}, published.points, OutputFolder(folder.path() / "page"));
  for (const char* text : {"Some One, 2001", "a figure", "sphere: another", "trace, ms: paper", "0.250"})
    EXPECT_NE(body.find(text), std::string::npos) << text;
}

}  // namespace
}  // namespace halfsilver::bench

namespace halfsilver {
namespace {

TEST(BenchPaper, OneCommandMeasuresAPaper) {
  const TemporaryFolder folder;
  const std::string command = "paper kastrati2017 -o DIR --quick --size 48x27";
  const ProgramResult result = runProgramIn(folder, command, "HALFSILVER_SCENES= ");
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_NE(result.out.find("Table 2"), std::string::npos);
  std::ifstream file(folder.path() / "DIR" / "paper.json");
  const nlohmann::json record = nlohmann::json::parse(file);
  std::set<std::string> rows;
  double wrongest = 0;
  for (const auto& point : record["points"]) {
    EXPECT_TRUE(rows.insert(point["row"].get<std::string>()).second) << point["row"];
    const std::string method = point["settings"]["trace.method"];
    if (method == "identity") {
      EXPECT_EQ(point["error"]["hit_error"], 0) << point["row"];
    }
    if (method == "attributes") {
      EXPECT_GT(point["memory"]["structure_total"], 100000) << point["row"];
      wrongest = std::max(wrongest, point["error"]["hit_error"].get<double>());
    }
    if (point["settings"]["select.mode"] == "all" && point["settings"]["select.fraction"] == 1) {
      EXPECT_GT(point["pixels"]["coverage"], 0.5) << point["row"];
    }
  }
  EXPECT_GT(rows.size(), 40u);
  EXPECT_GT(wrongest, 0);
  const auto files = filesIn(folder);
  EXPECT_EQ(std::count_if(files.begin(), files.end(), [](const std::string& name) { return name.ends_with(".png"); }),
            3);
  // What is there is not measured again.
  const ProgramResult again = runProgramIn(folder, command, "HALFSILVER_SCENES= ");
  EXPECT_EQ(again.exitCode, 0) << again.err;
  EXPECT_EQ(again.out, result.out);
}

TEST(BenchPaper, HusPageHoldsItsRulesAgainstTheAlternatives) {
  const TemporaryFolder folder;
  const ProgramResult result = runProgramIn(folder, "paper hu2014 -o DIR --quick --size 48x36", "HALFSILVER_SCENES= ");
  ASSERT_EQ(result.exitCode, 0) << result.err;
  std::ifstream file(folder.path() / "DIR" / "paper.json");
  const nlohmann::json record = nlohmann::json::parse(file);
  int depths = 0, planes = 0, ruled = 0, voxels = 0, unrefined = 0;
  for (const auto& point : record["points"]) {
    const auto& settings = point["settings"];
    if (settings["trace.method"] == "voxels") {
      ++voxels;
      EXPECT_EQ(settings["trace.effect"], "occlusion") << point["row"];
      EXPECT_GT(point["error"]["rmse"], 0) << point["row"];
    }
    if (settings["trace.method"] != "attributes") continue;
    settings["search.test"] == "depth" ? ++depths : ++planes;
    ruled += settings["voxels.resolution"] == "auto" ? 1 : 0;
    unrefined += settings["search.any_hit_refinements"] == 0 ? 1 : 0;
  }
  EXPECT_EQ(planes, 3);
  EXPECT_GT(depths, 20);
  EXPECT_EQ(ruled, 2);
  EXPECT_EQ(voxels, 2);
  EXPECT_GT(unrefined, 20);
  EXPECT_NE(readText(folder / "DIR/index.html").find("sparse voxel octree"), std::string::npos);
}

TEST(BenchPaper, RefinedShadowsAreCountedByWhetherRaysDecideThem) {
  const TemporaryFolder folder;
  const ProgramResult result =
      runProgramIn(folder, "paper beck2005 -o DIR --quick --size 96x72", "HALFSILVER_SCENES= ");
  ASSERT_EQ(result.exitCode, 0) << result.err;
  std::ifstream file(folder.path() / "DIR" / "paper.json");
  const nlohmann::json record = nlohmann::json::parse(file);
  int refined = 0;
  for (const auto& point : record["points"]) {
    if (point["settings"]["shadow.method"] != "refined" || point["shadows"].is_null()) continue;
    ++refined;
    const auto& shadows = point["shadows"];
    EXPECT_GT(shadows["marked"], 0) << point["row"];
    EXPECT_LT(shadows["marked"], shadows["pixels"]) << point["row"];
    EXPECT_EQ(shadows["wrong_marked"], 0) << point["row"];
    EXPECT_EQ(point["error"]["hit_error"], 0) << point["row"];
  }
  EXPECT_GT(refined, 12);
}

TEST(BenchPaper, TheSharesOfABufferAddUp) {
  const TemporaryFolder folder;
  const ProgramResult result =
      runProgramIn(folder, "paper robert2007 -o DIR --quick --size 80x60", "HALFSILVER_SCENES= ");
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_NE(result.out.find("Table 3"), std::string::npos);
  std::ifstream file(folder.path() / "DIR" / "paper.json");
  const nlohmann::json record = nlohmann::json::parse(file);
  int left = 0;
  for (const auto& point : record["points"]) {
    const std::uint64_t interpolated = point["interpolated"], pixels = point["pixels"]["total"];
    if (point["settings"]["primary.every"] == 2) {
      ++left;
      EXPECT_GE(interpolated, pixels / 2) << point["row"];
    } else {
      EXPECT_LT(interpolated, pixels / 20) << point["row"];
    }
    if (point["settings"]["primary.hits"] == "raster" && point["settings"]["primary.every"] == 1) {
      EXPECT_EQ(point["error"]["hit_error"], 0) << point["row"];
    }
  }
  EXPECT_EQ(left, 9);
}

TEST(BenchPaper, AnUnknownPaperIsToldWithThoseThatThereAre) {
  const TemporaryFolder folder;
  const ProgramResult result = runProgramIn(folder, "paper nobody1999 -o DIR --quick");
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_NE(result.err.find("kastrati2017"), std::string::npos) << result.err;
  EXPECT_TRUE(filesIn(folder).empty());
}

}  // namespace
}  // namespace halfsilver
