#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "bench/modes/pareto/pareto.h"
#include "bench/modes/pareto/report.h"
#include "bench/report/charts/gnuplot.h"
#include "contract/program.h"

namespace halfsilver {
namespace {

using bench::Accuracy;
using bench::ParetoPoint;
using bench::ParetoScene;

struct MadeUp {
  std::string name;
  std::vector<double> frames;  // ms
  double hitError = 0, perceptible = 0;
  double rays = 1;
  std::string beside = "";
};

std::vector<ParetoPoint> points(const std::vector<MadeUp>& variants, const std::string& scene = "made up") {
  std::vector<ParetoPoint> list;
  for (std::size_t round = 0; round < 5; ++round)
    for (const MadeUp& variant : variants) {
      if (round >= variant.frames.size()) continue;
      ParetoPoint point;
      point.scene.file = scene;
      point.preset = point.family = variant.name;
      point.beside = variant.beside;
      point.pixels.coverage = 0.5;
      point.memory.structureTotal = 2000000;
      point.times.frame.median = variant.frames[round];
      if (round == 0) point.errors = {{0.25, variant.perceptible}, {10, variant.rays, variant.hitError, 0.0, 0.0}};
      list.push_back(point);
    }
  return list;
}

ParetoScene sceneOf(const std::vector<MadeUp>& variants) { return bench::paretoScenes(points(variants)).at(0); }

std::vector<std::string> names(const ParetoScene& scene, const std::vector<std::size_t>& indices) {
  std::vector<std::string> result;
  for (const std::size_t i : indices) result.push_back(scene.variants[i].name);
  return result;
}

TEST(Pareto, RoundsBecomeOnePointAndRatiosArePaired) {
  // The machine became slower by half in the third round, for both alike.
  const ParetoScene scene = sceneOf({{"halfsilver", {100, 102, 150}}, {"other", {200, 255, 300}}, {"two", {10, 20}}});
  ASSERT_EQ(scene.variants.size(), 3u);
  EXPECT_EQ(scene.variants[1].frames, (std::vector<double>{200, 255, 300}));
  const bench::Spread time = bench::frameTime(scene.variants[1]);
  EXPECT_EQ(time.median, 255);
  EXPECT_EQ(time.min, 200);
  EXPECT_EQ(time.max, 300);
  const bench::Spread ratio = bench::pairedRatio(scene.variants[1], scene.variants[0]);
  EXPECT_EQ(ratio.median, 2);
  EXPECT_EQ(ratio.max, 2.5);
  EXPECT_EQ(bench::pairedRatio(scene.variants[2], scene.variants[0]).min, 0.1);
}

TEST(Pareto, TheFrontIsKnown) {
  const ParetoScene scene = sceneOf({{"slow and wrong", {50, 50}, 0.2, 0.2},
                                     {"halfsilver", {20, 20}, 0, 0},
                                     {"fast and wrong", {10, 10}, 0.1, 0.3},
                                     {"thinned", {5, 5}, 0, 0.25, 0.5},
                                     {"kept", {1, 1}, 0, 0, 1, "builds nothing"},
                                     {"as right, slower", {30, 30}, 0, 0.1}});
  // A variant that traces less cannot win by hits, one that does not compete cannot win at all.
  EXPECT_EQ(names(scene, bench::frontOf(scene, Accuracy::hits)),
            (std::vector<std::string>{"fast and wrong", "halfsilver"}));
  EXPECT_EQ(names(scene, bench::frontOf(scene, Accuracy::picture)),
            (std::vector<std::string>{"thinned", "halfsilver"}));
  EXPECT_EQ(bench::beatenBy(scene, 0, Accuracy::hits), 2u);  // the fastest of those that beat it
  EXPECT_EQ(bench::beatenBy(scene, 5, Accuracy::hits), 1u);
  EXPECT_EQ(bench::beatenBy(scene, 1, Accuracy::hits), std::nullopt);
  EXPECT_EQ(bench::beatenBy(scene, 4, Accuracy::hits), std::nullopt);
}

TEST(Pareto, VerdictsSayWhereTheDefaultStands) {
  const auto verdict = [](const MadeUp& other, Accuracy accuracy) {
    const ParetoScene scene = sceneOf({{"halfsilver", {10, 20, 30}, 0.01, 0.02}, other});
    return bench::paretoVerdicts(scene).at(accuracy == Accuracy::hits ? 0 : 1);
  };
  const MadeUp worse{"other", {5, 10, 15}, 0.02, 0.03};
  EXPECT_NE(verdict(worse, Accuracy::hits).find("on the front of the GPU methods:"), std::string::npos);
  EXPECT_EQ(verdict(worse, Accuracy::hits).find("not on the front"), std::string::npos);
  EXPECT_NE(verdict(worse, Accuracy::hits).find("made up, time against wrong hits"), std::string::npos);
  EXPECT_NE(verdict(worse, Accuracy::picture).find("perceptible pixels"), std::string::npos);

  const MadeUp better{"other", {5, 9, 15}, 0.01, 0.01};
  EXPECT_NE(verdict(better, Accuracy::hits)
                .find("not on the front. other takes 0.50 (0.45 to 0.50) times as long and is as accurate"),
            std::string::npos);
  EXPECT_NE(verdict(better, Accuracy::picture).find("and is more accurate"), std::string::npos);

  // Faster by the medians, but not in every round.
  const MadeUp alike{"other", {11, 19, 29}, 0.01, 0.02};
  EXPECT_NE(verdict(alike, Accuracy::hits).find("within the noise"), std::string::npos);
  // In every round, but only slightly.
  const MadeUp close{"other", {9.7, 19.4, 29.1}, 0.01, 0.02};
  EXPECT_NE(verdict(close, Accuracy::hits).find("within the noise"), std::string::npos);
  const ParetoScene alone = sceneOf({{"other", {1, 1}}});
  EXPECT_NE(bench::paretoVerdicts(alone).at(0).find("the default was not measured"), std::string::npos);
}

TEST(Pareto, MarksGrowByTenfoldMemory) {
  const double one = bench::markRadius(1e6), ten = bench::markRadius(1e7), hundred = bench::markRadius(1e8);
  EXPECT_GT(ten, one);
  EXPECT_NEAR(hundred - ten, ten - one, 1e-12);
  EXPECT_EQ(bench::markRadius(0), one);
}

TEST(Pareto, SlowFramesAreDrawnLessOften) {
  EXPECT_EQ(bench::roundsFor(0, false), 5);
  EXPECT_EQ(bench::roundsFor(bench::kParetoSeconds * 1000 / 5, false), 5);
  EXPECT_EQ(bench::roundsFor(bench::kParetoSeconds * 1000 / 3.5, false), 3);
  EXPECT_EQ(bench::roundsFor(1e9, false), 2);
  EXPECT_EQ(bench::roundsFor(1, true), 2);
}

TEST(Pareto, HitsAreComparedWhereBothTraced) {
  // Pixels: right, wrong, traced by the image alone, by the reference alone, by none.
  const auto image = [](std::vector<float> selected, std::vector<float> t) {
    Image result{5, 1, {"selected.Y", "hit.T", "hit.id"}, {}};
    for (std::size_t p = 0; p < 5; ++p) result.data.insert(result.data.end(), {selected[p], t[p], 7});
    return result;
  };
  const Image traced = image({1, 1, 1, 0, 0}, {2, -1, 5, -2, -2});
  const Image reference = image({1, 1, 0, 1, 0}, {2, 3, -2, 4, -2});
  const bench::CommonRays common = bench::compareCommonRays(traced, reference, 10);
  EXPECT_EQ(common.rays, 2u);
  EXPECT_NEAR(common.share, 2.0 / 3, 1e-12);
  EXPECT_EQ(common.hitError, 0.5);
  EXPECT_EQ(common.falseMiss, 0.5);
  EXPECT_EQ(common.falseHit, 0.0);
  const bench::CommonRays none = bench::compareCommonRays(image({0, 0, 0, 0, 0}, {-2, -2, -2, -2, -2}), reference, 10);
  EXPECT_EQ(none.rays, 0u);
  EXPECT_FALSE(none.hitError.has_value());
}

// Heights of the marks in a script, from the bottom.
std::vector<double> heights(const std::string& script) {
  std::vector<double> result;
  std::istringstream lines(script);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("set label \"\" at screen ") && line.find(" point pt 6") != line.npos)
      result.push_back(std::stod(line.substr(line.find(", screen ") + 9)));
  return result;
}

TEST(BenchChart, ZerosHaveARowOfTheirOwn) {
  const auto mark = [](double x, double y, const char* label) { return bench::Mark{x, y, 1, 0, false, false, label}; };
  const auto at = [](double x, double y) { return bench::Sample{x, y, 0, 0}; };
  const bench::ScatterGrid grid{
      1,
      {{mark(0, 0, "a \"name\"")}},
      {{"t", "ms", "wrong, %", {mark(10, 0, "none"), mark(20, 0.01, ""), mark(5, 30, "")}, {at(5, 30), at(10, 0)}},
       {"all right", "ms", "wrong, %", {mark(10, 0, "")}, {at(10, 0)}}}};
  const std::string script = bench::gnuplotScript(grid, bench::ChartFormat::svg);
  EXPECT_NE(script.find("\"a \\\"name\\\"\""), script.npos);
  for (const char* bad : {"nan", "inf"}) EXPECT_EQ(script.find(bad), script.npos);
  const std::vector<double> marks = heights(script);  // the legend's, then the panels'
  ASSERT_EQ(marks.size(), 5u);
  EXPECT_LT(marks[1], marks[2] - 0.02);
  EXPECT_LT(marks[2], marks[3]);
  if (const std::optional<std::string> svg = bench::runGnuplot(script)) {
    for (const char* text : {">none<", ">ms<", ">wrong, %<", ">0<", ">10<", ">all right<"})
      EXPECT_NE(svg->find(text), svg->npos) << text;
  }
}

TEST(BenchChart, LabelsDoNotOverlap) {
  bench::ScatterGrid grid{1, {}, {{"t", "ms", "%", {}, {}}}};
  for (int i = 0; i < 6; ++i) grid.panels[0].marks.push_back({100.0 + i, 1, 1, 0, false, false, "label"});
  const std::string script = bench::gnuplotScript(grid, bench::ChartFormat::svg);
  std::vector<std::pair<double, double>> places;
  std::istringstream lines(script);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("set label \"label\" at screen "))
      places.emplace_back(std::stod(line.substr(27)), std::stod(line.substr(line.find(", screen ") + 9)));
  ASSERT_EQ(places.size(), 6u);
  for (std::size_t a = 0; a < places.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_TRUE(std::abs(places[a].first - places[b].first) > 0.05 ||
                  std::abs(places[a].second - places[b].second) > 0.02);
}

TEST(Pareto, ThePageNamesEveryScene) {
  const std::vector<MadeUp> variants = {{"halfsilver", {10, 10}}, {"b<c", {20, 20}, 0.1, 0.1}};
  std::vector<ParetoPoint> list = points(variants, "one");
  for (const ParetoPoint& point : points(variants, "two")) list.push_back(point);
  const std::vector<ParetoScene> scenes = bench::paretoScenes(list);
  ASSERT_EQ(scenes.size(), 2u);
  EXPECT_EQ(bench::paretoChart(scenes).panels.size(), 4u);
  EXPECT_EQ(bench::paretoCsv(scenes).rows.size(), 4u);
  const std::string body = bench::paretoBody(scenes, {}, std::nullopt);
  for (const char* text : {"one, time against wrong hits: the default is on the front", "two, time against", "b&lt;c",
                           "behind halfsilver", "<h2>two</h2>"})
    EXPECT_NE(body.find(text), body.npos) << text;
  EXPECT_EQ(body.find("b<c"), body.npos);
}

#if HALFSILVER_EXACT
const std::string kQuick = "pareto builtin:sphere -o DIR --quick --size 64x36";

TEST(BenchPareto, MeasuresOnceAndReports) {
  const TemporaryFolder folder;
  ProgramResult result = runProgramIn(folder, kQuick);
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_NE(result.out.find("on the front"), std::string::npos);
  const std::vector<std::string> files = filesIn(folder);
  for (const char* name : {"DIR/pareto.csv", "DIR/pareto.json", "DIR/index.html", "DIR/builtin-sphere.png"})
    EXPECT_TRUE(std::binary_search(files.begin(), files.end(), name)) << name;

  const std::string text = readText(folder / "DIR/pareto.json");
  std::map<std::string, std::vector<nlohmann::json>> variants;  // their rounds
  const nlohmann::json record = readJson(folder / "DIR/pareto.json");
  for (const auto& point : record["points"]) {
    variants[point["preset"]].push_back(point);
    EXPECT_GT(point["time_ms"]["frame"]["median"], 0.0);
    EXPECT_GT(point["pixels"]["selected"], 100);
  }
  ASSERT_GE(variants.size(), 6u);
  for (const auto& [name, rounds] : variants) EXPECT_EQ(rounds.size(), 2u) << name;
  const auto error = [&](const char* variant, const char* name) { return variants.at(variant)[0]["error"][name]; };
  EXPECT_EQ(error("halfsilver", "hit_error"), 0.0);
  EXPECT_EQ(error("halfsilver", "rays_of_reference"), 1.0);
  EXPECT_LT(error("halfsilver", "rmse"), 0.002);
  EXPECT_GT(error("kastrati2017", "hit_error"), 0.001);
  EXPECT_GT(error("kastrati2017", "rmse"), 0.005);
  EXPECT_EQ(error("hu2014", "rays_of_reference"), 1.0);
  const char* thinned = "share of the pixels, 1/4 of the pixels";
  EXPECT_EQ(error(thinned, "hit_error"), 0.0);
  EXPECT_NEAR(error(thinned, "rays_of_reference").get<double>(), 0.25, 0.03);
  EXPECT_GT(error(thinned, "rmse"), 0.005);
  // What is rebuilt, and what is kept.
  EXPECT_GT(variants.at("halfsilver")[0]["time_ms"]["build"]["median"], 0.0);
  EXPECT_EQ(variants.at("halfsilver, kept")[0]["time_ms"]["build"]["median"], 0.0);

  std::istringstream csv(readText(folder / "DIR/pareto.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_NE(line.find("hit_error"), line.npos);
  std::size_t rows = 0;
  while (std::getline(csv, line)) ++rows;
  EXPECT_EQ(rows, variants.size());

  const std::string page = readText(folder / "DIR/index.html");
  EXPECT_NE(page.find("builtin:sphere, time against wrong hits: the default is"), page.npos);
  EXPECT_NE(page.find("data:image/png;base64,"), page.npos);
  for (const char* outside : {"src=\"http", "<link", "<script src"}) EXPECT_EQ(page.find(outside), page.npos);
  for (const std::string& file : {page, text}) EXPECT_EQ(file.find(folder.path().string()), file.npos);

  // The second run measures nothing again.
  result = runProgramIn(folder, kQuick);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(readText(folder / "DIR/pareto.json"), text);
}
#endif

}  // namespace
}  // namespace halfsilver
