#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

// The rooms of the house: who may include whom, and how long a file may be.
namespace halfsilver {
namespace {

namespace fs = std::filesystem;

// A room below renderer/, or of bench/, with the rooms that it may include besides itself. Whatever is not named is
// forbidden: upward edges and sisters. "settings", "renderer", "budget" and "calibration" are settings.* and so on,
// "shared" is shaders/shared, "bench" is bench/main.cpp.
const std::map<std::string, std::set<std::string>> kMayInclude = {
    {"core", {}},
    {"settings", {"core"}},
    {"scene", {"core", "shared"}},
    {"builtin", {"core", "scene"}},
    {"gl", {"core"}},
    {"frame", {"core", "scene", "gl", "settings", "shared"}},
    {"passes", {"core", "scene", "gl", "frame", "settings", "shared"}},
    {"effects", {"core", "scene", "gl", "frame", "settings", "shared"}},
    {"tracing", {"core", "scene", "gl", "frame", "settings", "shared"}},
    {"renderer", {"core", "scene", "gl", "frame", "settings", "shared", "passes", "tracing", "effects"}},
    {"context", {"core"}},
    {"budget", {"frame", "settings", "shared", "renderer"}},
    {"calibration", {"core", "scene", "settings", "renderer"}},
    {"io", {"core", "scene", "settings"}},
    {"exact", {"core", "scene", "gl", "frame", "settings", "shared", "tracing"}},
    {"apps",
     {"core", "scene", "builtin", "settings", "renderer", "budget", "calibration", "context", "io", "exact", "gl"}},
    {"bench/report", {"core", "io", "apps"}},
    {"bench/harness", {"core", "scene", "settings", "renderer", "context", "io", "apps", "gl"}},
    {"bench/modes",
     {"core", "scene", "builtin", "settings", "renderer", "io", "apps", "bench/harness", "bench/report"}},
    {"bench", {"apps", "bench/modes"}},
};

// The rooms of the public headers, include/halfsilver/, one per line.
// clang-format off
const std::map<std::string, std::string> kPublicHeaders = {
    {"bounds.h", "core"},
    {"budget.h", "budget"},
    {"builtin.h", "builtin"},
    {"cache_folder.h", "core"},
    {"calibration.h", "calibration"},
    {"context.h", "context"},
    {"draw_clusters.h", "scene"},
    {"error.h", "core"},
    {"exact.h", "exact"},
    {"frame_report.h", "renderer"},
    {"frame_view.h", "frame"},
    {"image.h", "core"},
    {"io.h", "io"},
    {"methods.h", "settings"},
    {"model.h", "scene"},
    {"pose.h", "scene"},
    {"primary_settings.h", "settings"},
    {"products.h", "frame"},
    {"ray_kinds.h", "core"},
    {"ray_reader.h", "frame"},
    {"renderer.h", "renderer"},
    {"scene.h", "scene"},
    {"scene_change.h", "scene"},
    {"scene_core.h", "scene"},
    {"settings.h", "settings"},
    {"shadow_settings.h", "settings"},
    {"shared_structs.h", "frame"},
    {"structure_cells.h", "core"},
    {"target.h", "core"},
    {"tracer.h", "tracing"},
    {"gl/api.h", "gl"},
    {"gl/buffer.h", "gl"},
    {"gl/functions.h", "gl"},
    {"gl/profiler.h", "gl"},
    {"gl/readback.h", "gl"},
    {"gl/texel_buffer.h", "gl"},
    {"gl/texture.h", "gl"},
    {"methods/attributes.h", "settings"},
    {"methods/depth_cube.h", "settings"},
    {"methods/identity.h", "settings"},
};
// clang-format on

struct Include {
  int line;
  std::string path;
};

std::vector<Include> includes(const fs::path& file) {
  std::vector<Include> found;
  std::ifstream in(file);
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    for (const std::string start : {"#include \"", "#include <halfsilver/"})
      if (line.rfind(start, 0) == 0) {
        const std::size_t from = line.find_first_of("\"<") + 1;
        found.push_back({number, line.substr(from, line.find_first_of("\">", from) - from)});
      }
  }
  return found;
}

// The room of a path below renderer/ or of an include; empty where it is in none.
std::string room(const fs::path& path) {
  std::string text = path.generic_string();
  if (text.rfind("include/", 0) == 0) text = text.substr(8);
  if (text.rfind("halfsilver/", 0) == 0) {
    const auto known = kPublicHeaders.find(text.substr(11));
    return known == kPublicHeaders.end() ? "" : known->second;
  }
  const std::string first = path.begin() == path.end() ? "" : path.begin()->string();
  if (first == "bench") {
    const std::string inner = "bench/" + std::next(path.begin())->string();
    return kMayInclude.contains(inner) ? inner : inner == "bench/main.cpp" ? first : "";
  }
  if (first != path) return kMayInclude.contains(first) || first == "shared" ? first : "";
  const std::string stem = path.stem().string();
  if (stem == "frame_record" || stem == "picture" || stem.starts_with("renderer_")) return "renderer";
  return stem == "settings" || stem == "renderer" || stem == "budget" || stem == "calibration" ? stem : "";
}

bool isPublic(const fs::path& file) { return file.generic_string().rfind("include/", 0) == 0; }

// What is wrong with an include of `included` in `file`, a path below renderer/.
std::optional<std::string> complaint(const fs::path& file, const std::string& included) {
  const std::string from = room(file), to = room(included);
  if (from.empty()) return "the file is in no room";
  if (to.empty()) return "the included file is in no room";
  if (from != to && !kMayInclude.at(from).contains(to)) return from + " may not include " + to;
  if (isPublic(file) && included.rfind("halfsilver/", 0) != 0 && to != "shared")
    return "a public header includes public headers only";
  // A method's folder under tracing/ is for methods.cpp and itself only.
  const std::string folder = fs::path(included).parent_path().string();
  if (folder.rfind("tracing/", 0) == 0 && file.parent_path() != folder && file != "tracing/methods.cpp")
    return "a method's folder is its own";
  // So is a mode's under bench/modes/, for bench/main.cpp and itself only. Charts know nothing else.
  if (folder.rfind("bench/modes/", 0) == 0 && file.parent_path() != folder && file != "bench/main.cpp")
    return "a mode's folder is its own";
  const std::string charts = "bench/report/charts";
  if (file.parent_path() == charts && folder != charts && folder.rfind("bench/", 0) == 0)
    return "charts include charts only";
  return std::nullopt;
}

std::vector<fs::path> filesBelow(const std::string& folder, const std::set<std::string>& extensions) {
  std::vector<fs::path> files;
  if (!fs::exists(fs::path(HALFSILVER_SOURCE_DIR) / folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(HALFSILVER_SOURCE_DIR) / folder))
    if (entry.is_regular_file() && extensions.contains(entry.path().extension().string()))
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

TEST(Layering, IncludesPointOneWay) {
  const fs::path project(HALFSILVER_SOURCE_DIR), root = project / "renderer";
  std::vector<fs::path> files = filesBelow("renderer", {".h", ".cpp"});
  ASSERT_GT(files.size(), 20u);
  const std::vector<fs::path> bench = filesBelow("bench", {".h", ".cpp"});
  files.insert(files.end(), bench.begin(), bench.end());
  std::size_t count = 0;
  for (const fs::path& file : files) {
    const fs::path inProject = file.lexically_relative(project);
    const fs::path path = *inProject.begin() == "renderer" ? file.lexically_relative(root) : inProject;
    for (const Include& include : includes(file)) {
      ++count;
      if (const auto wrong = complaint(path, include.path))
        ADD_FAILURE() << inProject.string() << ":" << include.line << " includes \"" << include.path
                      << "\": " << *wrong;
    }
  }
  EXPECT_GT(count, files.size()) << "include lines must have been found";
}

TEST(Layering, RulesForbidUpwardEdgesAndSisters) {
  EXPECT_FALSE(complaint("passes/gbuffer.cpp", "halfsilver/products.h"));
  EXPECT_FALSE(complaint("tracing/methods.cpp", "tracing/identity/identity_tracer.h"));
  EXPECT_FALSE(complaint("tracing/identity/identity_tracer.cpp", "tracing/grid.h"));
  EXPECT_TRUE(complaint("include/halfsilver/image.h", "halfsilver/scene.h"));
  EXPECT_TRUE(complaint("gl/buffer.cpp", "halfsilver/scene.h"));
  EXPECT_TRUE(complaint("passes/gbuffer.cpp", "halfsilver/tracer.h"));
  EXPECT_TRUE(complaint("io/gltf.cpp", "halfsilver/context.h"));
  EXPECT_TRUE(complaint("io/gltf.cpp", "halfsilver/renderer.h"));
  EXPECT_TRUE(complaint("tracing/attributes/attribute_tracer.cpp", "tracing/identity/identity_tracer.h"));
  EXPECT_TRUE(complaint("io/gltf.cpp", "apps/commands.h"));
  EXPECT_FALSE(complaint("bench/main.cpp", "bench/modes/memory/memory.h"));
  EXPECT_FALSE(complaint("bench/modes/memory/memory.cpp", "bench/modes/mode.h"));
  EXPECT_FALSE(complaint("bench/modes/memory/memory.cpp", "bench/harness/truth.h"));
  EXPECT_FALSE(complaint("bench/modes/memory/report.cpp", "bench/report/charts/chart.h"));
  EXPECT_TRUE(complaint("apps/render.cpp", "bench/report/table.h"));
  EXPECT_TRUE(complaint("bench/modes/memory/memory.cpp", "passes/gbuffer.h"));
  EXPECT_TRUE(complaint("bench/modes/memory/memory.cpp", "bench/modes/pareto/front.h"));
  EXPECT_TRUE(complaint("bench/modes/mode.cpp", "bench/modes/pareto/front.h"));
  EXPECT_TRUE(complaint("bench/harness/tasks.cpp", "bench/modes/mode.h"));
  EXPECT_TRUE(complaint("bench/harness/tasks.cpp", "bench/report/table.h"));
  EXPECT_TRUE(complaint("bench/report/report.cpp", "bench/modes/mode.h"));
  EXPECT_TRUE(complaint("bench/report/report.cpp", "bench/harness/points.h"));
  EXPECT_TRUE(complaint("bench/report/charts/panels.cpp", "bench/report/table.h"));
  EXPECT_TRUE(complaint("bench/report/charts/panels.cpp", "bench/modes/pareto/front.h"));
  EXPECT_TRUE(complaint("bench/memory.cpp", "halfsilver/error.h"));
  EXPECT_TRUE(complaint("gl/buffer.cpp", "nowhere.h"));
  EXPECT_TRUE(complaint("gl/buffer.cpp", "halfsilver/nowhere.h"));
  EXPECT_TRUE(complaint("include/halfsilver/renderer.h", "gl/program.h"));
}

// Heavy libraries and windows stay where they are: each header in one room, or in one file.
TEST(Layering, LibrariesStayInTheirPlace) {
  const std::map<std::string, std::string> places = {
      {"tiny_gltf.h", "io/gltf"}, {"OpenImageIO/", "io/openimageio_module.cpp"},
      {"embree3/", "exact/"},     {"EGL/", "context/egl.cpp"},
      {"CLI/", "apps/"},          {"GLFW/", "apps/"},
      {"toml++/", "io/"}};
  const fs::path root = fs::path(HALFSILVER_SOURCE_DIR) / "renderer";
  for (const fs::path& file : filesBelow("renderer", {".h", ".cpp"})) {
    const std::string path = file.lexically_relative(root).generic_string();
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);)
      for (const auto& [library, place] : places)
        if (line.rfind("#include <" + library, 0) == 0) {
          EXPECT_EQ(path.rfind(place, 0), 0u) << path << " includes " << library << ", which belongs to " << place;
        }
  }
}

TEST(Layering, FilesAreOneThing) {
  const std::map<std::string, int> limits = {{".h", 180},    {".cpp", 600},  {".glsl", 250},
                                             {".vert", 250}, {".frag", 250}, {".comp", 250}};
  std::set<std::string> extensions;
  for (const auto& limit : limits) extensions.insert(limit.first);
  for (const char* folder : {"renderer", "shaders", "tests", "bench"})
    for (const fs::path& file : filesBelow(folder, extensions)) {
      std::ifstream in(file);
      const auto lines = std::count(std::istreambuf_iterator<char>(in), {}, '\n');
      const std::string extension = file.extension().string();
      const int limit = std::string(folder) == "bench" && extension == ".cpp" ? 400 : limits.at(extension);
      EXPECT_LE(lines, limit) << file.lexically_relative(HALFSILVER_SOURCE_DIR);
    }
}

}  // namespace
}  // namespace halfsilver
