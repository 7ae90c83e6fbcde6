#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <functional>
#include <sstream>

#include "contract/program.h"

namespace halfsilver {
namespace {

const std::string kQuick = "memory builtin:sphere -o DIR --quick --size 96x54";

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void expectConsistent(const nlohmann::json& point) {
  SCOPED_TRACE(point["preset"]);
  const nlohmann::json& memory = point["memory"];
  const auto bytes = [&](const char* name) { return memory[name].get<double>(); };
  EXPECT_GE(bytes("pool_reserved"), bytes("pool_used"));
  EXPECT_LE(bytes("fragments_stored"), bytes("fragments"));
  EXPECT_GE(bytes("structure_total"), bytes("voxels") + bytes("heads") + bytes("pool_reserved"));
  double held = 0;
  for (const char* part :
       {"structure_total", "transient", "pictures", "queues", "gbuffer", "geometry", "textures", "shadow_maps"}) {
    const bool mayBeNone = part == std::string("transient") || part == std::string("pictures");
    EXPECT_GT(bytes(part), mayBeNone ? -1 : 0) << part;
    held += bytes(part);
  }
  EXPECT_EQ(bytes("peak"), held);
  double stored = 0;
  for (const auto& axis : memory["fragments_per_axis"]) stored += axis.get<double>();
  EXPECT_EQ(stored, bytes("fragments_stored"));
  EXPECT_NEAR(bytes("pool_used"), stored * bytes("bytes_per_fragment"), 0.5);
  EXPECT_EQ(point["lost_fragments"], 0);
  EXPECT_FALSE(point["version"].get<std::string>().empty());
  EXPECT_FALSE(point["device"]["renderer"].get<std::string>().empty());
  EXPECT_FALSE(point["settings"].empty());
}

nlohmann::json pointOf(const nlohmann::json& record, const std::string& preset) {
  for (const auto& point : record["points"])
    if (point["preset"] == preset) return point;
  ADD_FAILURE() << "no point " << preset;
  return {};
}

TEST(BenchMemory, MeasuresOnceAndReports) {
  const TemporaryFolder folder;
  ProgramResult result;
  const double first = seconds([&] { result = runProgramIn(folder, kQuick); });
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_NE(result.out.find("kastrati2017"), std::string::npos);
  const std::vector<std::string> files = filesIn(folder);
  for (const char* name : {"DIR/memory.csv", "DIR/memory.json", "DIR/index.html", "DIR/builtin-sphere.png"})
    EXPECT_TRUE(std::binary_search(files.begin(), files.end(), name)) << name;

  const std::string text = readText(folder / "DIR/memory.json");
  const nlohmann::json record = readJson(folder / "DIR/memory.json");
  for (const auto& point : record["points"]) expectConsistent(point);
  const auto stored = [&](const char* preset) { return pointOf(record, preset)["memory"]["fragments_stored"]; };
  EXPECT_LT(stored("kastrati2017"), stored("hu2014 all"));
  EXPECT_EQ(stored("kastrati2017 three"), stored("hu2014 all"));
  const auto selected = [&](const char* preset) { return pointOf(record, preset)["pixels"]["selected"]; };
  EXPECT_LT(selected("hu2014 reflective"), selected("hu2014 all"));
#if HALFSILVER_EXACT
  EXPECT_EQ(pointOf(record, "halfsilver")["error"]["hit_error"], 0.0);
  EXPECT_EQ(pointOf(record, "reference")["error"]["hit_error"], 0.0);
#endif

  // The table: one row per point, all rows as long as the header.
  std::istringstream csv(readText(folder / "DIR/memory.csv"));
  std::string line;
  std::getline(csv, line);
  const auto columns = std::count(line.begin(), line.end(), ',');
  for (const char* column : {"scene", "preset", "pool_reserved", "pool_used", "pool_wasted", "structure_total",
                             "structure_over_hu2014", "structure_over_kastrati2017", "hit_error"})
    EXPECT_NE((',' + line + ',').find(',' + std::string(column) + ','), std::string::npos) << column;
  std::size_t rows = 0;
  for (; std::getline(csv, line); ++rows) EXPECT_EQ(std::count(line.begin(), line.end(), ','), columns) << line;
  EXPECT_EQ(rows, record["points"].size());

  // The page fetches nothing and does not reveal the machine's folders.
  const std::string page = readText(folder / "DIR/index.html");
  EXPECT_NE(page.find("182.37"), std::string::npos);
  EXPECT_NE(page.find("data:image/png;base64,"), std::string::npos);
  for (const char* outside : {"src=\"http", "<link", "<script src"}) EXPECT_EQ(page.find(outside), std::string::npos);
  for (const std::string& file : {page, text, readText(folder / "DIR/memory.csv")})
    EXPECT_EQ(file.find(folder.path().string()), std::string::npos);

  // The second run measures nothing again.
  const double second = seconds([&] { result = runProgramIn(folder, kQuick); });
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_LT(second, first);
  EXPECT_EQ(readText(folder / "DIR/memory.json"), text);
}

TEST(BenchMemory, BadRequestsWriteNothing) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  std::filesystem::create_directory(folder / "other");
  std::ofstream(folder / "other/memory.json") << "{}";
  const std::vector<std::string> before = filesIn(folder);
  const auto expectRefused = [&](const std::string& arguments, int exitCode, const std::string& environment = "") {
    SCOPED_TRACE(arguments);
    const ProgramResult result = runProgramIn(folder, arguments, environment);
    EXPECT_EQ(result.exitCode, exitCode) << result.err;
    EXPECT_TRUE(result.err.starts_with("halfsilver-bench: ")) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(filesIn(folder), before);
  };
  expectRefused("", 2);
  expectRefused("haste builtin:sphere -o DIR", 2);
  expectRefused("memory -o DIR", 2);
  expectRefused("memory builtin:sphere", 2);
  expectRefused("memory builtin:sphere builtin:sphere -o DIR", 2);
  expectRefused("memory builtin:sphere builtin:teapot -o DIR --camera 0", 2);
  expectRefused("memory builtin:sphere -o DIR --size 0x1", 2);
  expectRefused("memory builtin:sphere -o DIR --mirror nosuch=1", 2);
  expectRefused("memory missing.glb -o DIR", 3);
  expectRefused("memory builtin:sphere missing.glb -o DIR", 3);
  expectRefused("memory builtin:sphere -o other --quick", 3);
  expectRefused("memory builtin:sphere -o file --quick", 1);
  expectRefused("memory builtin:sphere -o DIR/a/b --context egl", 4, "__EGL_VENDOR_LIBRARY_FILENAMES=/dev/null");
}

}  // namespace
}  // namespace halfsilver
