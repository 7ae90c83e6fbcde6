#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "bench/modes/coverage/report.h"
#include "contract/program.h"

namespace halfsilver {
namespace {

const std::string kQuick = "coverage builtin:sphere -o DIR --quick --preset halfsilver --size 64x36";

TEST(BenchCoverage, MeasuresOnceAndReports) {
  const TemporaryFolder folder;
  ProgramResult result = runProgramIn(folder, kQuick);
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_NE(result.out.find("scattered"), std::string::npos);
  const std::vector<std::string> files = filesIn(folder);
  for (const char* name : {"DIR/coverage.csv", "DIR/coverage_fits.csv", "DIR/coverage.json", "DIR/index.html",
                           "DIR/builtin-sphere-all-traced.png"})
    EXPECT_TRUE(std::binary_search(files.begin(), files.end(), name)) << name;

  const std::string text = readText(folder / "DIR/coverage.json");
  const nlohmann::json record = readJson(folder / "DIR/coverage.json");
  ASSERT_EQ(record["points"].size(), 30u);
  std::map<std::string, std::map<double, nlohmann::json>> curves;
  for (const auto& point : record["points"])
    curves[point["settings"]["select.pattern"]][point["settings"]["select.fraction"]] = point;
  ASSERT_EQ(curves.size(), 2u);
  for (const auto& [pattern, curve] : curves) {
    SCOPED_TRACE(pattern);
    ASSERT_EQ(curve.size(), 5u);
    const nlohmann::json &none = curve.at(0), &all = curve.at(1);
    EXPECT_EQ(none["pixels"]["selected"], 0);
    EXPECT_EQ(none["memory"]["pool_used"], 0);
    EXPECT_GT(all["pixels"]["coverage"], 0.5);
    EXPECT_EQ(all["pixels"]["coverage"], curves["region"][1]["pixels"]["coverage"]);
    double before = -1, held = -1;
    for (const auto& [fraction, point] : curve) {
      EXPECT_GT(point["pixels"]["coverage"], before);
      EXPECT_GE(point["memory"]["pool_used"], held);
      EXPECT_GT(point["time_ms"]["frame"]["median"], 0.0);
      before = point["pixels"]["coverage"];
      held = point["memory"]["pool_used"];
    }
    // Everything is rebuilt in each frame.
    EXPECT_GT(all["time_ms"]["build"]["median"], 0.0);
    EXPECT_GT(all["memory"]["pool_used"], 0);
  }
  // A region needs what lies in it, scattered rays nearly everything.
  const auto held = [&](const char* pattern) { return curves[pattern][1.0 / 32]["memory"]["pool_used"].get<double>(); };
  EXPECT_LT(held("region"), held("scattered"));

  for (const auto& [name, rows] : {std::pair("DIR/coverage.csv", 10u), {"DIR/coverage_fits.csv", 10u}}) {
    SCOPED_TRACE(name);
    std::istringstream csv(readText(folder / name));
    std::string line;
    std::getline(csv, line);
    const auto columns = std::count(line.begin(), line.end(), ',');
    EXPECT_GT(columns, 8);
    std::size_t found = 0;
    for (; std::getline(csv, line); ++found) EXPECT_EQ(std::count(line.begin(), line.end(), ','), columns) << line;
    EXPECT_EQ(found, rows);
  }

  const std::string page = readText(folder / "DIR/index.html");
  EXPECT_NE(page.find("R²"), std::string::npos);
  EXPECT_NE(page.find("data:image/png;base64,"), std::string::npos);
  for (const char* outside : {"src=\"http", "<link", "<script src"}) EXPECT_EQ(page.find(outside), std::string::npos);
  for (const std::string& file : {page, text}) EXPECT_EQ(file.find(folder.path().string()), std::string::npos);

  // The second run measures nothing again.
  result = runProgramIn(folder, kQuick);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(readText(folder / "DIR/coverage.json"), text);
}

bench::CoveragePoint madeUp(SelectPattern pattern, double fraction, double traceMs) {
  bench::CoveragePoint point;
  point.scene.file = "made up";
  point.preset = "halfsilver";
  point.settings.select.pattern = pattern;
  point.settings.select.fraction = static_cast<float>(fraction);
  point.pixels.coverage = fraction;
  point.times.voxelize = point.times.build = point.times.trace = point.times.frame = {traceMs, traceMs, traceMs, 1, 0};
  point.memory.structureTotal = point.memory.poolReserved = point.memory.poolUsed = 2000000;
  return point;
}

TEST(CoverageReport, RoundsBecomeOnePoint) {
  // A line from 1 to 5 ms, except for one round of one point in which the machine had other work.
  std::vector<bench::CoveragePoint> points;
  for (const double late : {0.0, 100.0, 0.5})
    for (const double fraction : {1.0, 0.0, 0.03125, 0.5})
      points.push_back(madeUp(SelectPattern::region, fraction, 1 + 4 * fraction + (fraction == 0.5 ? late : 0)));
  const bench::CoverageCurves curves = bench::coverageCurves(points);
  ASSERT_EQ(curves.size(), 1u);
  ASSERT_EQ(curves[0].points.size(), 4u);
  const bench::Timing& half = curves[0].points[2].times.trace;
  EXPECT_EQ(half.median, 3.5);
  EXPECT_EQ(half.min, 3.0);
  EXPECT_EQ(half.max, 103.0);
  EXPECT_EQ(half.runs, 3u);
  EXPECT_EQ(curves[0].points[3].times.trace.median, 5.0);

  const bench::Table fits = bench::fitsCsv(curves);
  ASSERT_EQ(fits.rows.size(), 5u);
  const auto cell = [&](std::size_t row, const char* column) {
    const auto at = std::find(fits.columns.begin(), fits.columns.end(), column) - fits.columns.begin();
    return fits.rows[row].at(static_cast<std::size_t>(at));
  };
  EXPECT_EQ(cell(0, "quantity"), "trace");
  EXPECT_NEAR(std::stod(cell(0, "slope")), 4, 0.2);
  EXPECT_EQ(cell(0, "small_share_over_whole"), "0.225000");  // 1.125 of 5 ms
  EXPECT_EQ(cell(3, "quantity"), "structure");
  EXPECT_EQ(cell(3, "r_squared"), "");  // constant
  EXPECT_EQ(cell(3, "small_share_over_whole"), "1.000000");
}

// The same step of the scattered pixels shows what a jump of the region comes from.
TEST(CoverageReport, JumpsAreExplained) {
  const auto pageOf = [](double inRegion, double inScattered) {
    std::vector<bench::CoveragePoint> points;
    for (int i = 0; i <= 32; ++i) {
      const double fraction = i / 32.0;
      points.push_back(madeUp(SelectPattern::region, fraction, 32 * fraction + (i > 11 ? inRegion : 0)));
      points.push_back(madeUp(SelectPattern::scattered, fraction, 32 * fraction + (i > 11 ? inScattered : 0)));
    }
    return bench::coverageBody(bench::coverageCurves(points), {}, std::nullopt);
  };
  const std::string region = pageOf(9, 0), both = pageOf(9, 9), none = pageOf(0, 0);
  EXPECT_NE(region.find("34.4 % and 37.5 %</td>"), region.npos);
  EXPECT_NE(region.find("in the region alone"), region.npos);
  EXPECT_NE(both.find("in both patterns"), both.npos);
  EXPECT_NE(none.find("no jump</td>"), none.npos);
}

TEST(BenchCoverage, PresetsThatCannotBeMeasuredAreRefused) {
  const TemporaryFolder folder;
  for (const char* presets : {"--preset nosuch", "--preset deferred", "--preset halfsilver --preset halfsilver"}) {
    SCOPED_TRACE(presets);
    const ProgramResult result = runProgramIn(folder, kQuick + " " + presets);
    EXPECT_EQ(result.exitCode, 2) << result.err;
    EXPECT_TRUE(result.err.starts_with("halfsilver-bench: ")) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_TRUE(filesIn(folder).empty());
  }
}

}  // namespace
}  // namespace halfsilver
