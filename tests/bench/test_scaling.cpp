#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "bench/harness/fit.h"
#include "bench/modes/scaling/report.h"
#include "bench/modes/scaling/scenes.h"
#include "bench/report/charts/gnuplot.h"
#include "contract/program.h"

namespace halfsilver::bench {
namespace {

TEST(PowerLaw, IsFoundExactly) {
  std::vector<XY> points;
  for (const double x : {1e4, 3e4, 1e5, 1e6}) points.push_back({x, 0.02 * std::pow(x, 0.75)});
  const auto law = fitPowerLaw(points);
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->exponent, 0.75, 1e-9);
  EXPECT_NEAR(law->factor, 0.02, 1e-9);
  EXPECT_NEAR(*law->rSquared, 1, 1e-9);
  EXPECT_EQ(law->first, 0u);
  EXPECT_NEAR(law->at(1e8), 2e4, 1e-3);
}

// The fixed cost of a frame dominates small points: the law is that of the large ones.
TEST(PowerLaw, BeginsBehindABreak) {
  std::vector<XY> points;
  for (int i = 0; i <= 12; ++i) {
    const double x = std::pow(10, 0.5 * i);
    points.push_back({x, std::max(100.0, x * x / 100)});  // the break is at x = 100
  }
  const auto law = fitPowerLaw(points);
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->exponent, 2, 0.05);
  EXPECT_GE(points[law->first].x, 30);
  EXPECT_LE(points[law->first].x, 100.1);
}

TEST(PowerLaw, ConstantsHaveTheExponentNone) {
  const auto law = fitPowerLaw(std::vector<XY>{{1, 5}, {10, 5}, {100, 5}});
  ASSERT_TRUE(law);
  EXPECT_EQ(law->exponent, 0);
  EXPECT_FALSE(law->rSquared);
  EXPECT_NEAR(law->factor, 5, 1e-12);
}

TEST(PowerLaw, NeedsThreePointsThatFit) {
  EXPECT_FALSE(fitPowerLaw(std::vector<XY>{}));
  EXPECT_FALSE(fitPowerLaw(std::vector<XY>{{1, 1}, {10, 10}}));
  EXPECT_FALSE(fitPowerLaw(std::vector<XY>{{1, 1}, {10, 100}, {100, 1}}));
  EXPECT_FALSE(fitPowerLaw(std::vector<XY>{{2, 1}, {2, 2}, {2, 3}}));
}

double doubleArea(const Scene& scene, const Triangle& triangle) {
  const auto corner = [&](std::size_t i) { return glm::dvec3(scene.vertices[triangle.vertices[i]].position); };
  return glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
}

double areaOf(const Scene& scene, const std::string& material) {
  double area = 0;
  for (const Triangle& triangle : scene.triangles)
    if (scene.materials[triangle.material].name == material) area += 0.5 * doubleArea(scene, triangle);
  return area;
}

TEST(ScalingScenes, HaveTheTrianglesThatTheyPromise) {
  for (const std::size_t wanted : {1000, 10000, 31623, 100000, 316228}) {
    SCOPED_TRACE(wanted);
    const auto finer = static_cast<double>(subdividedScene(wanted).scene.triangles.size());
    EXPECT_NEAR(finer, static_cast<double>(wanted), 0.01 * static_cast<double>(wanted));
    const auto more = static_cast<double>(crowdedScene(wanted).scene.triangles.size());
    EXPECT_NEAR(more, static_cast<double>(wanted), 98);
  }
}

TEST(ScalingScenes, OnlyTheTrianglesGrow) {
  const Scene coarse = subdividedScene(10000).scene, fine = subdividedScene(100000).scene;
  // The same surface, of some size, with mirrors around it.
  EXPECT_GT(areaOf(fine, "clay"), 5);
  EXPECT_NEAR(areaOf(coarse, "clay") / areaOf(fine, "clay"), 1, 0.01);
  EXPECT_NEAR(areaOf(coarse, "mirror"), areaOf(fine, "mirror"), 1e-4);
  EXPECT_GT(areaOf(fine, "mirror"), 10);
  EXPECT_NEAR(coarse.bounds().diagonal(), fine.bounds().diagonal(), 0.01);
  // Objects keep their size and the world grows.
  const Scene few = crowdedScene(10000).scene, many = crowdedScene(100000).scene;
  EXPECT_GT(many.bounds().extent().x, 2.5f * few.bounds().extent().x);
  EXPECT_NEAR(many.bounds().extent().y, few.bounds().extent().y, 1e-5);
  const auto areaOfPillars = [](const Scene& scene) {
    double area = 0;
    for (const char* material : {"red", "yellow", "green", "blue"}) area += areaOf(scene, material);
    return area / static_cast<double>(scene.triangles.size());
  };
  EXPECT_GT(areaOfPillars(few), 0.01);
  EXPECT_NEAR(areaOfPillars(many) / areaOfPillars(few), 1, 0.01);
  // What is around the camera's target is the same.
  const auto near = [](const Scene& scene) {
    std::set<std::array<float, 3>> positions;
    for (const Vertex& vertex : scene.vertices)
      if (std::abs(vertex.position.x) < 3 && std::abs(vertex.position.z) < 3)
        positions.insert({vertex.position.x, vertex.position.y, vertex.position.z});
    return positions;
  };
  EXPECT_GT(near(few).size(), 1000u);
  EXPECT_EQ(near(few), near(many));
  EXPECT_EQ(few.cameras[0].eye, many.cameras[0].eye);
}

TEST(ScalingScenes, NormalsPointOutwards) {
  const Scene scene = subdividedScene(20000).scene;
  std::size_t outwards = 0, all = 0;
  for (const Triangle& triangle : scene.triangles) {
    if (scene.materials[triangle.material].name != "clay") continue;
    const auto corner = [&](std::size_t i) -> const Vertex& { return scene.vertices[triangle.vertices[i]]; };
    const glm::vec3 face = glm::cross(corner(1).position - corner(0).position, corner(2).position - corner(0).position);
    ++all;
    outwards += glm::dot(face, corner(0).normal) > 0;
  }
  EXPECT_GT(all, 15000u);
  EXPECT_EQ(outwards, all);
  // The knot is highest where its normals point up.
  const auto highest =
      std::max_element(scene.vertices.begin(), scene.vertices.end(), [&](const Vertex& a, const Vertex& b) {
        return a.position.y * (std::abs(a.position.x) < 1.9f) < b.position.y * (std::abs(b.position.x) < 1.9f);
      });
  EXPECT_GT(highest->normal.y, 0.95f);
}

TEST(ScalingScenes, HaveTheirLights) {
  for (const std::size_t lights : {1, 2, 64}) EXPECT_EQ(crowdedScene(1000, lights).scene.lights.size(), lights);
}

// A point as it is measured; times grow with the square of the value.
ScalingPoint point(const std::string& axis, const std::string& preset, double value) {
  ScalingPoint result;
  result.scene = {"made up", 0, 1};
  result.axis = axis;
  result.preset = preset;
  result.value = value;
  result.size = {16, 9};
  result.seconds = 1;
  result.triangles = static_cast<std::size_t>(value);
  TimedFrame& frame = result.frame.emplace();
  frame.pixels.selected = 7;
  for (const auto stage :
       {&Times::gbuffer, &Times::select, &Times::voxelize, &Times::build, &Times::trace, &Times::shade, &Times::frame})
    (frame.times.*stage).median = 1e-6 * value * value;
  frame.memory.structureTotal = static_cast<std::uint64_t>(3 * value);
  return result;
}

std::string cell(const Table& table, std::size_t row, const std::string& column) {
  const auto at = std::find(table.columns.begin(), table.columns.end(), column) - table.columns.begin();
  return table.rows.at(row).at(static_cast<std::size_t>(at));
}

TEST(ScalingReport, AFailedPointEndsItsSeriesAndIsTold) {
  std::vector<ScalingPoint> points;
  for (const double value : {1000.0, 3000.0, 10000.0}) points.push_back(point("finer", "a", value));
  ScalingPoint failed = point("finer", "a", 30000);
  failed.seconds.reset();
  failed.frame.reset();
  failed.failed = "out of <memory>";
  points.push_back(failed);
  for (const double value : {1000.0, 3000.0, 10000.0}) points.push_back(point("finer", "b", value));
  points.back().seconds = 31;
  EXPECT_FALSE(stops(points[0], 20));
  EXPECT_TRUE(stops(failed, 20));
  EXPECT_TRUE(stops(points.back(), 20));
  EXPECT_FALSE(stops(points.back(), 40));

  const ScalingSeries series = scalingSeries(points);
  ASSERT_EQ(series.size(), 2u);
  const Table limits = limitsTable(series, 20);
  EXPECT_EQ(cell(limits, 0, "works up to"), "10k");
  EXPECT_EQ(cell(limits, 0, "ends at"), "30k");
  EXPECT_EQ(cell(limits, 0, "how"), "out of <memory>");
  EXPECT_EQ(cell(limits, 1, "ends at"), "10k");
  EXPECT_NE(cell(limits, 1, "how").find("31.0 s"), std::string::npos);
  EXPECT_EQ(cell(limitsTable(series, 40), 1, "how"), "no end was found");

  const Table laws = exponentsCsv(series);
  EXPECT_EQ(cell(laws, 0, "quantity"), "build");
  EXPECT_EQ(cell(laws, 0, "exponent"), "2.0000");
  EXPECT_EQ(cell(laws, 3, "quantity"), "structure");
  EXPECT_EQ(cell(laws, 3, "exponent"), "1.0000");
  EXPECT_EQ(cell(laws, 3, "points"), "3");  // without the failed one

  const Table csv = scalingCsv(series);
  ASSERT_EQ(csv.rows.size(), 7u);
  for (const auto& row : csv.rows) EXPECT_EQ(row.size(), csv.columns.size());
  EXPECT_EQ(cell(csv, 3, "fault"), "out of <memory>");
  const std::string body = scalingBody(series, {}, 20, std::nullopt);
  EXPECT_NE(body.find("out of &lt;memory&gt;"), body.npos);
}

TEST(ScalingReport, FaultsAreToldAndDoNotCount) {
  const ScalingPoint good = point("lights", "a", 8);
  EXPECT_FALSE(fault(good));
  ScalingPoint lost = good, overflow = good, warned = good;
  lost.frame->lostFragments = 12;
  overflow.frame->overflow = 3;
  warned.frame->warnings = {"one", "two"};
  EXPECT_NE(fault(lost)->find("12 fragments"), std::string::npos);
  EXPECT_EQ(fault(overflow), "3 rays overflowed");
  EXPECT_EQ(fault(warned), "one; two");
  for (const ScalingPoint& bad : {lost, overflow, warned}) EXPECT_TRUE(stops(bad, 20));

  std::vector<ScalingPoint> points;
  for (const double value : {1.0, 2.0, 4.0}) points.push_back(point("lights", "a", value));
  points.push_back(lost);
  points.back().frame->times.trace.median = 1e6;
  const Table laws = exponentsCsv(scalingSeries(points));
  EXPECT_EQ(cell(laws, 1, "exponent"), "2.0000");
  EXPECT_EQ(cell(laws, 1, "to"), "4.000");
}

TEST(ScalingReport, ChartsAreLogarithmic) {
  std::vector<ScalingPoint> points;
  for (const double value : {1000.0, 10000.0, 100000.0, 1e6}) points.push_back(point("more", "a", value));
  const PanelGrid grid = scalingChart(scalingSeries(points));
  ASSERT_EQ(grid.panels.size(), 3u);
  ASSERT_EQ(grid.panels[0].curves.size(), 2u);  // points and law
  ASSERT_EQ(grid.panels[0].ticks.size(), 4u);
  EXPECT_EQ(grid.panels[0].ticks[3].label, "1M");
  const std::string script = gnuplotScript(grid, ChartFormat::svg);
  EXPECT_NE(script.find("set logscale xy"), script.npos);
  if (const std::optional<std::string> svg = runGnuplot(script)) {
    for (const char* text : {">100k<", ">1M<", ">a<"}) EXPECT_NE(svg->find(text), svg->npos) << text;
  }
}

TEST(BenchScaling, MeasuresOnceAndReports) {
  const TemporaryFolder folder;
  const std::string command = "scaling -o DIR --quick --size 48x27 --preset halfsilver";
  ProgramResult result = runProgramIn(folder, command);
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const std::vector<std::string> files = filesIn(folder);
  for (const char* name : {"DIR/scaling.csv", "DIR/scaling_exponents.csv", "DIR/scaling_limits.csv", "DIR/scaling.json",
                           "DIR/index.html", "DIR/finer-triangles.png", "DIR/more-objects.png"})
    EXPECT_TRUE(std::binary_search(files.begin(), files.end(), name)) << name;

  const std::string text = readText(folder / "DIR/scaling.json");
  std::map<std::string, std::map<double, nlohmann::json>> axes;
  const nlohmann::json record = readJson(folder / "DIR/scaling.json");
  for (const auto& measured : record["points"]) {
    EXPECT_FALSE(measured.contains("failed")) << measured;
    axes[measured["axis"]][measured["value"]] = measured;
  }
  ASSERT_EQ(axes.size(), 6u);
  for (const auto& [axis, curve] : axes) {
    SCOPED_TRACE(axis);
    ASSERT_EQ(curve.size(), 3u);
    for (const auto& [value, measured] : curve) {
      EXPECT_GT(measured["time_ms"]["trace"]["median"], 0.0);
      EXPECT_GT(measured["memory"]["structure_total"], 0);
      EXPECT_GT(measured["pixels"]["selected"], 50);
    }
  }
  // Along an axis only its own quantity grows.
  const auto selected = [&](const char* axis, double value) {
    return axes[axis].at(value)["pixels"]["selected"].get<double>();
  };
  for (const char* axis : {"finer", "more"}) {
    EXPECT_GT(axes[axis].at(100000)["triangles"], 90000);
    EXPECT_NEAR(selected(axis, 100000) / selected(axis, 10000), 1, 0.05) << axis;
  }
  EXPECT_NEAR(selected("pixels", 57600) / selected("pixels", 3600), 16, 1);
  EXPECT_NEAR(selected("coverage", 100) / selected("coverage", 6.25), 16, 2);
  EXPECT_EQ(axes["lights"].at(4)["scene"]["lights"], 4);
  EXPECT_EQ(axes["bounces"].at(4)["settings"]["trace.bounces"], 4);

  const std::string page = readText(folder / "DIR/index.html");
  for (const char* part : {"Exponents", "Where it ends", "All points"}) EXPECT_NE(page.find(part), page.npos) << part;
  EXPECT_NE(page.find("data:image/png;base64,"), page.npos);
  result = runProgramIn(folder, command);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(readText(folder / "DIR/scaling.json"), text);
}

TEST(BenchScaling, TheTimeLimitEndsEveryAxis) {
  const TemporaryFolder folder;
  const ProgramResult result =
      runProgramIn(folder, "scaling -o DIR --quick --size 16x9 --preset halfsilver --time-limit 0.000001");
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(readJson(folder / "DIR/scaling.json")["points"].size(), 6u);
  EXPECT_NE(readText(folder / "DIR/scaling_limits.csv").find("larger ones were not tried"), std::string::npos);
  for (const char* bad : {"--time-limit 0", "--time-limit -1", "--preset nosuch", "--preset deferred"})
    EXPECT_EQ(runProgramIn(folder, std::string("scaling -o OTHER ") + bad).exitCode, 2) << bad;
}

}  // namespace
}  // namespace halfsilver::bench
