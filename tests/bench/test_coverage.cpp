#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "contract/program.h"

namespace halfsilver {
namespace {

const std::string kQuick = "coverage builtin:sphere -o DIR --quick --size 96x54";

TEST(BenchCoverage, MeasuresOnceAndReports) {
  const TemporaryFolder folder;
  ProgramResult result = runProgramIn(folder, kQuick);
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_NE(result.out.find("scattered"), std::string::npos);
  const std::vector<std::string> files = filesIn(folder);
  for (const char* name :
       {"DIR/coverage.csv", "DIR/coverage_fits.csv", "DIR/coverage.json", "DIR/index.html", "DIR/builtin-sphere.png"})
    EXPECT_TRUE(std::binary_search(files.begin(), files.end(), name)) << name;

  const std::string text = readText(folder / "DIR/coverage.json");
  const nlohmann::json record = readJson(folder / "DIR/coverage.json");
  ASSERT_EQ(record["points"].size(), 10u);
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
      EXPECT_EQ(point["time_ms"]["frame"]["runs"], 3);
      before = point["pixels"]["coverage"];
      held = point["memory"]["pool_used"];
    }
    // All is built anew in each frame.
    EXPECT_EQ(all["time_ms"]["build"]["runs"], 3);
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
