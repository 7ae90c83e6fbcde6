#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "bench/harness/gl_work.h"
#include "bench/modes/speed/lanes.h"
#include "contract/program.h"

namespace halfsilver::bench {
namespace {

TEST(LanesAtWork, AreThoseThatTheSlowestRayOfAGroupLeaves) {
  EXPECT_EQ(lanesAtWork({}, 8), 1);
  const std::vector<RayWork> equal(16, {3, 2});
  EXPECT_EQ(lanesAtWork(equal, 8), 1);
  // One of eight works twice as long as the others; the second group has four rays only.
  std::vector<RayWork> work(12, {1, 1});
  work[3] = {2, 2};
  EXPECT_DOUBLE_EQ(lanesAtWork(work, 8), (7 * 2 + 4 + 4 * 2) / (8 * 4 + 8 * 2.0));
  EXPECT_LT(lanesAtWork(work, 32), lanesAtWork(work, 8));
}

// What a count may be, per scene: counts do not depend on the machine. A tenth above what was measured.
struct Bounds {
  const char* scene;
  const char* preset;
  double steps, tests, bytesPerTriangle;
  int firstWaits, warmWaits, warmDispatches;
};
constexpr Bounds kBounds[] = {{"builtin:sphere", "halfsilver", 12.8, 9.8, 15, 1, 0, 14},
                              {"builtin:sphere", "bvh", 15.4, 5.1, 21.3, 4, 1, 8},
                              {"builtin:teapot", "halfsilver", 12.7, 13, 19.3, 1, 0, 14},
                              {"builtin:teapot", "bvh", 16.4, 7.9, 21.9, 4, 1, 8}};

TEST(BenchSpeed, CountsStayWithinTheirBounds) {
  const TemporaryFolder folder;
  const std::string command = "speed builtin:sphere builtin:teapot --preset halfsilver --preset bvh --quick -o DIR";
  const ProgramResult result = runProgramIn(folder, command);
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const std::vector<std::string> files = filesIn(folder);
  for (const char* name : {"DIR/speed.csv", "DIR/speed.json", "DIR/index.html", "DIR/builtin-sphere.png"})
    EXPECT_TRUE(std::binary_search(files.begin(), files.end(), name)) << name;
  const nlohmann::json points = readJson(folder / "DIR/speed.json")["points"];
  ASSERT_EQ(points.size(), std::size(kBounds));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const nlohmann::json& point = points[i];
    const Bounds& bounds = kBounds[i];
    SCOPED_TRACE(std::string(bounds.scene) + ", " + bounds.preset);
    ASSERT_EQ(point["scene"]["file"], bounds.scene);
    ASSERT_EQ(point["preset"], bounds.preset);
    EXPECT_GT(point["pixels"]["selected"], 2000);
    EXPECT_GT(point["search"]["steps_per_ray"], bounds.steps / 4);
    EXPECT_LE(point["search"]["steps_per_ray"], bounds.steps);
    EXPECT_GT(point["search"]["tests_per_ray"], 1);
    EXPECT_LE(point["search"]["tests_per_ray"], bounds.tests);
    EXPECT_LE(point["bytes_per_triangle"], bounds.bytesPerTriangle);
    EXPECT_LE(point["first"]["waits"], bounds.firstWaits);
    EXPECT_LE(point["warm"]["waits"], bounds.warmWaits);
    EXPECT_LE(point["warm"]["dispatches"], bounds.warmDispatches);
    EXPECT_GE(point["warm"]["dispatches"], 5);
    EXPECT_GT(point["object"]["draws"], point["warm"]["draws"]) << "shadows are drawn again";
    EXPECT_LT(point["search"]["lanes_of_32"], point["search"]["lanes_of_8"]);
    EXPECT_GT(point["search"]["lanes_of_32"], 0.2);
    EXPECT_GT(point["rays_per_second"], 0);
    EXPECT_GT(point["rays_per_core_second"], 0);
    EXPECT_EQ(point["warm"]["time_ms"]["build"]["runs"], 0) << "nothing is built while nothing changes";
    for (const char* kind : {"first", "object", "tenth", "everything"})
      EXPECT_GT(point[kind]["time_ms"]["build"]["median"], 0) << kind;
    EXPECT_GT(point["first"]["time_ms"]["shadow"]["median"], 0);
    EXPECT_GT(point["build_ms_per_million_triangles"], 0);
  }
  const std::string page = readText(folder / "DIR/index.html");
  for (const char* text : {"Lanes at work", "A warm frame", "The first frame", "Structures and moves",
                           "Rays while triangles move", "Waits"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
}

}  // namespace
}  // namespace halfsilver::bench
