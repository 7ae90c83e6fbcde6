#include <gtest/gtest.h>

#include <algorithm>

#include <halfsilver/error.h>
#include "bench/harness/point.h"
#include "bench/harness/tasks.h"
#include "bench/harness/workbench.h"
#include "contract/program.h"

namespace halfsilver::bench {

struct SizedKey {
  std::string series;
  int size = 0;
};
template <>
inline constexpr auto kFields<SizedKey> =
    std::tuple{field("series", &SizedKey::series), field("size", &SizedKey::size)};

struct Duration {
  double seconds = 0;
};
template <>
inline constexpr auto kFields<Duration> = std::tuple{field("seconds", &Duration::seconds)};

using SizedPoint = Point<SizedKey, Duration>;

namespace {

Request requestOf(std::vector<std::string> scenes, std::vector<std::string> mirrors,
                  std::vector<std::string> views = {}) {
  Request request;
  request.scenes = std::move(scenes);
  request.mirrors = std::move(mirrors);
  checkRequest(request, {"", "", "", std::move(views)});
  return request;
}

std::optional<float> mirrorOf(const BenchScene& scene, const std::string& material) {
  for (const Material& m : scene.model.scene.materials)
    if (m.name == material) return m.mirror;
  ADD_FAILURE() << scene.name << " has no material " << material;
  return {};
}

TEST(BenchScenes, AMirrorIsForTheScenesThatHaveTheMaterial) {
  // Only the atrium has a "floor".
  const auto scenes = loadScenes(requestOf({"builtin:rods", "builtin:atrium"}, {"floor=0.5"}));
  EXPECT_TRUE(scenes[0].mirrors.empty());
  EXPECT_EQ(scenes[1].mirrors, std::vector<std::string>{"floor=0.5"});
  EXPECT_EQ(mirrorOf(scenes[1], "floor"), 0.5f);
  EXPECT_THROW(loadScenes(requestOf({"builtin:rods", "builtin:sheets"}, {"floor=0.5"})), Error);
  EXPECT_THROW(loadScenes(requestOf({"builtin:rods"}, {"floor=0.5"})), Error);
}

TEST(BenchScenes, AMirrorCanBeForOneScene) {
  const auto scenes =
      loadScenes(requestOf({"builtin:rods", "builtin:sheets"}, {"red=0.25", "builtin:sheets:red=0.75"}));
  EXPECT_EQ(mirrorOf(scenes[0], "red"), 0.25f);
  EXPECT_EQ(mirrorOf(scenes[1], "red"), 0.75f);
  EXPECT_EQ(scenes[0].mirrors, std::vector<std::string>{"red=0.25"});
  EXPECT_EQ(scenes[1].mirrors, (std::vector<std::string>{"red=0.25", "red=0.75"}));
  EXPECT_THROW(loadScenes(requestOf({"builtin:rods", "builtin:sheets"}, {"builtin:sheets:floor=1"})), Error);
}

TEST(BenchScenes, EachHasItsView) {
  const auto scenes = loadScenes(requestOf({"builtin:rods", "builtin:sheets"}, {}, {"builtin:sheets=1,2,3,0,0,1,90"}));
  EXPECT_EQ(scenes[0].camera.eye, loadScenes(requestOf({"builtin:rods"}, {}))[0].camera.eye);
  EXPECT_EQ(scenes[1].camera.eye, glm::vec3(1, 2, 3));
  EXPECT_EQ(scenes[1].camera.target, glm::vec3(0, 0, 1));
  EXPECT_NEAR(scenes[1].camera.verticalFov, glm::radians(90.0f), 1e-6);
  // A file is known by its path and by its name.
  EXPECT_EQ(requestOf({"a/b.glb"}, {}, {"a/b.glb=1,2,3,0,0,1"}).views[0].scene, "b.glb");
  EXPECT_EQ(requestOf({"a/b.glb"}, {}, {"b.glb=1,2,3,0,0,1"}).views[0].scene, "b.glb");
  for (const std::vector<std::string>& bad :
       {std::vector<std::string>{"c.glb=1,2,3,0,0,1"}, {"b.glb=1,2,3,0,0,1", "a/b.glb=1,2,3,0,0,2"}, {"b.glb=1,2,3"}})
    EXPECT_THROW(requestOf({"a/b.glb"}, {}, bad), Error);
}

TEST(BenchTasks, ASeriesEndsAndOthersGoOn) {
  const TemporaryFolder folder;
  std::vector<std::string> measured;
  const auto task = [&](const std::string& series, int size) {
    return anyTask(Task<SizedPoint>{.key = {series, size},
                                    .label = series,
                                    .measure =
                                        [&measured, series, size] {
                                          measured.push_back(series + std::to_string(size));
                                          return Duration{series == "slow" ? 10.0 * size : 1};
                                        },
                                    .series = series,
                                    .ends = [](const SizedPoint& point) { return point.seconds > 15; }});
  };
  const auto run = [&] {
    std::vector<Batch> batches;
    batches.push_back(
        {"m",
         Points(folder / "m.json", "m"),
         {task("slow", 1), task("fast", 1), task("slow", 2), task("fast", 2), task("slow", 3), task("fast", 3)}});
    return measureAll(batches);
  };
  EXPECT_EQ(run().at(0).size(), 5u);
  EXPECT_EQ(measured, (std::vector<std::string>{"slow1", "fast1", "slow2", "fast2", "fast3"}));
  EXPECT_EQ(run().at(0).size(), 5u);
  EXPECT_EQ(measured.size(), 5u);  // all were kept, and a kept point ends its series, too
}

// Every part is on the one page; what is kept is not measured again.
TEST(BenchAll, OnePageOfAllModes) {
  const TemporaryFolder folder;
  const std::string command =
      "all builtin:rods -o DIR --quick --size 48x32 --method halfsilver --preset halfsilver --time-limit 0.01";
  ProgramResult result = runProgramIn(folder, command);
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const std::vector<std::string> modes = {"memory", "coverage", "pareto", "stability", "scaling"};
  const std::string page = readText(folder / "DIR/index.html");
  std::vector<std::string> records;
  std::size_t last = 0;
  for (const std::string& mode : modes) {
    SCOPED_TRACE(mode);
    EXPECT_NE(page.find("<a href=\"#" + mode + "\">"), page.npos);
    const std::size_t at = page.find("<article id=\"" + mode + "\">");
    ASSERT_NE(at, page.npos);
    EXPECT_GT(at, last);
    last = at;
    EXPECT_NE(result.out.find(mode + '\n'), std::string::npos);
    records.push_back(readText(folder / ("DIR/" + mode + ".json")));
    EXPECT_GT(readJson(folder / ("DIR/" + mode + ".json"))["points"].size(), 4u);
    EXPECT_GT(readText(folder / ("DIR/" + mode + ".csv")).size(), 100u);
  }
  // What all parts have in common is said once.
  ASSERT_NE(page.find("Measured with"), std::string::npos);
  EXPECT_EQ(page.find("Measured with"), page.rfind("Measured with"));
  ASSERT_NE(page.find("<!DOCTYPE html>"), std::string::npos);
  EXPECT_EQ(page.find("<!DOCTYPE html>"), page.rfind("<!DOCTYPE html>"));

  result = runProgramIn(folder, command);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  for (std::size_t i = 0; i < modes.size(); ++i)
    EXPECT_EQ(readText(folder / ("DIR/" + modes[i] + ".json")), records[i]) << modes[i];
  EXPECT_EQ(runProgramIn(folder, "all -o DIR").exitCode, 2);
  EXPECT_EQ(runProgramIn(folder, "all builtin:rods -o DIR --method nosuch").exitCode, 2);
  EXPECT_EQ(runProgramIn(folder, "all builtin:rods -o DIR --preset nosuch").exitCode, 2);
}

}  // namespace
}  // namespace halfsilver::bench
