#include <gtest/gtest.h>

#include <fstream>
#include <optional>
#include <tuple>

#include <halfsilver/error.h>
#include "bench/harness/estimate.h"
#include "bench/harness/output_folder.h"
#include "bench/harness/points.h"
#include "bench/modes/memory/memory.h"
#include "bench/modes/memory/point.h"
#include "bench/report/charts/chart.h"
#include "bench/report/charts/gnuplot.h"
#include "bench/report/page.h"
#include "bench/report/table.h"
#include "temporary_folder.h"

namespace halfsilver::bench {

struct Inner {
  std::uint64_t count = 0;
};
template <>
inline constexpr auto kFields<Inner> = std::tuple{field("count", &Inner::count)};

struct Outer {
  std::string name;
  std::optional<double> error, time;
  std::optional<Inner> inner;
};
template <>
inline constexpr auto kFields<Outer> = std::tuple{field("name", &Outer::name), field("error", &Outer::error),
                                                  field("time_ms", &Outer::time, Empty::omitted), group(&Outer::inner)};

namespace {

namespace fs = std::filesystem;

TEST(BenchTable, CsvQuotesWhatNeedsIt) {
  const Table table{{"scene", "bytes"}, {{"a,b", "1"}, {"say \"x\"", ""}, {"two\nlines", "2"}}};
  EXPECT_EQ(toCsv(table), "scene,bytes\n\"a,b\",1\n\"say \"\"x\"\"\",\n\"two\nlines\",2\n");
}

TEST(BenchTable, HtmlIsEscapedAndNumbersAreRightAligned) {
  const std::string html = toHtml({{"a&b"}, {{"<script>"}, {"12.5"}}});
  EXPECT_NE(html.find("<th>a&amp;b</th>"), html.npos);
  EXPECT_NE(html.find("<td>&lt;script&gt;</td>"), html.npos);
  EXPECT_NE(html.find("<td class=\"number\">12.5</td>"), html.npos);
  EXPECT_EQ(escapeHtml("\"a\" < b > c & d"), "&quot;a&quot; &lt; b &gt; c &amp; d");
}

TEST(BenchTable, TextIsAligned) {
  EXPECT_EQ(toText({{"name", "MB"}, {{"a", "1.5"}, {"longer", "10.25"}}}),
            "name    MB\na         1.5\nlonger  10.25\n");
}

TEST(BenchEstimate, GrowsWithTheWorkThatIsLeft) {
  Estimate estimate;
  estimate.plan(10);
  estimate.plan(30);
  EXPECT_EQ(estimate.left(), "");
  estimate.done(10, 5);
  EXPECT_EQ(estimate.left(), "about 15 s left");
  estimate.plan(3600);
  EXPECT_EQ(estimate.left(), "about 30 min left");
  estimate.done(3630, 1);
  EXPECT_EQ(estimate.left(), "about 0 s left");
}

TEST(BenchPage, PicturesAreInIt) {
  EXPECT_NE(thumbnail("Man", "m").find("data:image/png;base64,TWFu\""), std::string::npos);
  EXPECT_NE(thumbnail("Ma", "m").find("base64,TWE=\""), std::string::npos);
  EXPECT_NE(thumbnail(std::string_view("\xff", 1), "m").find("base64,/w==\""), std::string::npos);
  EXPECT_EQ(inlineSvg("<?xml version=\"1.0\"?>\n<svg a=\"b\"></svg>"), "<svg a=\"b\"></svg>");
  EXPECT_EQ(bullets({"a", "b & c"}), "<ul>\n<li>a</li>\n<li>b &amp; c</li>\n</ul>\n");
  EXPECT_NE(page("a < b", "<p>x</p>").find("<title>a &lt; b</title>"), std::string::npos);
}

TEST(BenchChart, NamesCannotLeaveTheirQuotes) {
  const StackedBars chart{"t\"; system \"x", "MB", {"part"}, {{"g\\\n", "n", {2}, "2"}, {"other", "m", {0}, "0"}}};
  const std::string script = gnuplotScript(chart, ChartFormat::svg);
  EXPECT_NE(script.find("set title \"t\\\"; system \\\"x\"\n"), script.npos);
  EXPECT_NE(script.find("\"g\\\\\""), script.npos);
  EXPECT_EQ(script.find("nan"), script.npos);
  EXPECT_EQ(script.find("inf"), script.npos);
}

TEST(BenchChart, PanelsHoldTheirCurves) {
  const PanelGrid grid{
      2,
      {{"a \"title\"", "x", "ms", {{"seen", {{0, 1, 0.5, 2}, {1, 3, 3, 3}}}, {"", {{0, 1, 1, 1}}, 1, false}}},
       {"b", "x", "MB", {{"other", {}}}},
       {"c", "x", "MB", {{"last", {{0, 0, 0, 0}}}}}}};
  const std::string script = gnuplotScript(grid, ChartFormat::svg);
  EXPECT_NE(script.find("layout 2,2"), script.npos);
  EXPECT_NE(script.find("set title \"a \\\"title\\\"\""), script.npos);
  EXPECT_NE(script.find("\n0 1 0.5 2\n1 3 3 3\n"), script.npos);
  EXPECT_NE(script.find("title \"seen\""), script.npos);
  EXPECT_NE(script.find("notitle"), script.npos);
  if (const std::optional<std::string> svg = runGnuplot(script)) {
    for (const char* text : {">seen<", ">other<", ">last<", ">MB<"}) EXPECT_NE(svg->find(text), svg->npos) << text;
  }
}

Scene oneTriangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  Scene scene;
  for (const glm::vec3& position : {a, b, c}) {
    scene.vertices.emplace_back();
    scene.vertices.back().position = position;
  }
  scene.triangles = {{{0, 1, 2}, 0}};
  return scene;
}

TEST(SingleOverThree, IsOneForFloorsAndAThirdForTheDiagonal) {
  EXPECT_NEAR(singleOverThree(oneTriangle({0, 0, 0}, {1, 0, 0}, {0, 0, 1})), 1, 1e-9);
  EXPECT_NEAR(singleOverThree(oneTriangle({0, 0, 0}, {1, 0, 0}, {0, 1, 1})), 0.5, 1e-9);
  EXPECT_NEAR(singleOverThree(oneTriangle({1, 0, 0}, {0, 1, 0}, {0, 0, 1})), 1.0 / 3, 1e-9);
  EXPECT_EQ(singleOverThree(Scene()), 1);
}

TEST(BenchPoints, AreKeptAndFoundByTheirKey) {
  const TemporaryFolder folder;
  const fs::path file = folder / "memory.json";
  {
    Points points(file, "memory");
    EXPECT_FALSE(fs::exists(file));
    points.keep({{"preset", "a"}, {"size", {160, 90}}, {"result", 0.1}});
  }
  const Points points(file, "memory");
  const auto* found = points.find({{"preset", "a"}, {"size", {160, 90}}});
  ASSERT_NE(found, nullptr);
  EXPECT_EQ((*found)["result"], 0.1);
  EXPECT_EQ(points.find({{"preset", "a"}, {"size", {160, 91}}}), nullptr);
  EXPECT_EQ(points.find({{"preset", "a"}, {"device", "x"}}), nullptr);
  EXPECT_THROW(Points(file, "coverage"), Error);
  for (const char* text : {"", "{", "[]", R"({"mode": "memory", "points": [3]})"}) {
    std::ofstream(file) << text;
    EXPECT_THROW(Points(file, "memory"), Error) << text;
  }
}

TEST(BenchFields, AStructIsReadAsItWasWritten) {
  const Outer full{"a", 0.5, 1.25, Inner{7}}, empty{"b", {}, {}, {}};
  EXPECT_EQ(nlohmann::ordered_json(full).dump(), R"({"name":"a","error":0.5,"time_ms":1.25,"count":7})");
  EXPECT_EQ(nlohmann::ordered_json(empty).dump(), R"({"name":"b","error":null})");
  const auto readFull = fromJson<Outer>(full), readEmpty = fromJson<Outer>(empty);
  EXPECT_EQ(readFull.error, 0.5);
  EXPECT_EQ(readFull.time, 1.25);
  ASSERT_TRUE(readFull.inner);
  EXPECT_EQ(readFull.inner->count, 7u);
  EXPECT_EQ(readEmpty.name, "b");
  EXPECT_FALSE(readEmpty.error || readEmpty.time || readEmpty.inner);
  EXPECT_THROW(fromJson<Outer>({{"error", 1}}), Error);
  EXPECT_THROW(fromJson<Outer>({{"name", 3}}), Error);
  EXPECT_EQ(keyOf(&Outer::time), "time_ms");
}

TEST(BenchFields, SettingsSurviveTheFile) {
  MemoryPoint point;
  set(point.settings, "voxels.resolution", "64");
  set(point.settings, "select.fraction", "0.1");
  set(point.settings, "select.mode", "all");
  const auto read = fromJson<MemoryPoint>(nlohmann::ordered_json::parse(nlohmann::ordered_json(point).dump()));
  EXPECT_EQ(read.settings, point.settings);
  EXPECT_NE(read.settings, Settings());
}

TEST(OutputFolder, IsRemovedIfNothingWasPutIntoIt) {
  const TemporaryFolder folder;
  { const OutputFolder output(folder / "a/b/"); }
  EXPECT_FALSE(fs::exists(folder / "a"));
  {
    const OutputFolder output(folder / "a/b");
    std::ofstream(output / "file") << "x";
  }
  EXPECT_TRUE(fs::exists(folder / "a/b/file"));
  EXPECT_THROW(OutputFolder(folder / "a/b/file"), Error);
  EXPECT_THROW(OutputFolder(folder / "a/b/file/c"), Error);
}

}  // namespace
}  // namespace halfsilver::bench
