#include "bench/memory.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "apps/drawing.h"
#include "apps/progress.h"
#include "bench/estimate.h"
#include "bench/memory_report.h"
#include "bench/points.h"
#include "bench/workbench.h"
#include "io/atomic_file.h"
#include "io/compare.h"
#include "io/settings_file.h"

namespace halfsilver::bench {
namespace {

using Json = nlohmann::ordered_json;

// Kastrati & Goswami 2017, section 4.1: 64^3 voxels, and 256^3 for Sponza's 262,000 triangles.
constexpr std::size_t kLargeScene = 150000;  // triangles
constexpr const char* kDefaultPreset = "halfsilver";
constexpr const char* kReference = "reference";

struct Variant {
  std::string name;
  Settings settings;
};

Settings paperSettings(const std::string& preset, bool quick, std::size_t triangles) {
  Settings settings;
  applyPreset(settings, preset);
  settings.voxels.resolution = quick ? 32 : triangles > kLargeScene ? 256 : 64;
  settings.abuffer.resolution = quick ? 256 : 1024;
  return settings;
}

// The systems that are compared. Kastrati's own A-buffer in all three axes is there, too: it differs from his in
// nothing but the number of A-buffers, while Hu's has linked lists.
std::vector<Variant> variants(bool quick, std::size_t triangles, bool exact) {
  std::vector<Variant> all;
  Settings settings;
  applyPreset(settings, kDefaultPreset);
  all.push_back({kDefaultPreset, settings});
  const Settings kastrati = paperSettings("kastrati2017", quick, triangles);
  all.push_back({"kastrati2017", kastrati});
  settings = kastrati;
  settings.abuffer.buffers = Buffers::three;
  all.push_back({"kastrati2017 three", settings});
  settings = paperSettings("hu2014", quick, triangles);
  settings.select.mode = SelectMode::reflective;
  all.push_back({"hu2014 reflective", settings});
  settings.select.mode = SelectMode::all;
  all.push_back({"hu2014 all", settings});
  if (exact) {
    settings = {};
    applyPreset(settings, kReference);
    all.push_back({kReference, settings});
  }
  return all;
}

// The layers of the reference for a scene, by the pixels that are selected.
class Truth {
 public:
  const Image& layers(Workbench& bench, const BenchScene& scene, SelectMode mode) {
    if (scene_ != &scene) layers_.clear();
    scene_ = &scene;
    if (const auto known = layers_.find(mode); known != layers_.end()) return known->second;
    Settings settings;
    applyPreset(settings, kReference);
    settings.select.mode = mode;
    RunStatistics run = bench.describe(scene, settings);
    bench.draw(scene, run);
    return layers_[mode] = bench.layers();
  }

 private:
  const BenchScene* scene_ = nullptr;
  std::map<SelectMode, Image> layers_;
};

std::string readBytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string pictureName(const BenchScene& scene) {
  std::string name = scene.name;
  std::replace(name.begin(), name.end(), ':', '-');
  return name + ".png";
}

// The points of a request: those that the folder holds, and the others measured.
class Measurement {
 public:
  Measurement(const Request& request, const std::vector<BenchScene>& scenes, const OutputFolder& folder,
              Workbench& bench)
      : folder_(&folder), bench_(&bench), points_(folder / "memory.json", "memory") {
    for (const BenchScene& scene : scenes) {
      const bool exact = static_cast<bool>(exactFactory(scene.model.scene, 0));
      for (const Variant& variant : variants(request.quick, scene.model.scene.triangles.size(), exact)) {
        Json key = pointKey(bench.describe(scene, variant.settings), scene);
        key["preset"] = variant.name;
        const bool known = points_.find(key) != nullptr;
        if (!known) estimate_.plan(work(scene));
        tasks_.push_back({&scene, variant, std::move(key), known});
      }
    }
  }

  std::vector<Json> run() {
    Progress progress;
    std::vector<Json> results;
    for (const Task& task : tasks_) {
      if (!task.known) {
        const std::string left = estimate_.left();
        progress.show("point " + std::to_string(results.size() + 1) + " of " + std::to_string(tasks_.size()) + ": " +
                      task.scene->name + ", " + task.variant.name + (left.empty() ? "" : ", " + left));
        const auto start = std::chrono::steady_clock::now();
        measure(task);
        estimate_.done(work(*task.scene),
                       std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      }
      results.push_back(*points_.find(task.key));
    }
    return results;
  }

  std::string picture(const BenchScene& scene) const { return readBytes(*folder_ / pictureName(scene)); }

 private:
  struct Task {
    const BenchScene* scene;
    Variant variant;
    Json key;
    bool known;
  };

  // Time grows with the triangles, above what every frame takes.
  static double work(const BenchScene& scene) {
    return 20000 + static_cast<double>(scene.model.scene.triangles.size());
  }

  void measure(const Task& task) {
    Json point = task.key;
    RunStatistics run = bench_->describe(*task.scene, task.variant.settings);
    bench_->draw(*task.scene, run);
    addMeasured(point, run);
    point["single_over_three"] = singleOverThree(task.scene->model.scene);
    point["error"] = nullptr;
    if (task.variant.name == kDefaultPreset) writePicture(*task.scene);
    if (exactFactory(task.scene->model.scene, 0)) {
      const Image layers = bench_->layers();
      const Image& truth = truth_.layers(*bench_, *task.scene, task.variant.settings.select.mode);
      point["error"] = toJson(compareImages({layers, true, task.scene->diagonal}, {truth, true, task.scene->diagonal}));
    }
    points_.keep(std::move(point));
  }

  void writePicture(const BenchScene& scene) {
    AtomicFile file(*folder_ / pictureName(scene));
    file.write(bench_->thumbnail());
    file.commit();
  }

  const OutputFolder* folder_;
  Workbench* bench_;
  Points points_;
  Truth truth_;
  Estimate estimate_;
  std::vector<Task> tasks_;
};

// All files of the report, each whole before any appears.
void writeReport(const OutputFolder& folder, const std::vector<Json>& points, const std::vector<ScenePicture>& scenes) {
  const StackedBars chart = memoryChart(points);
  const std::optional<std::string> svg = runGnuplot(gnuplotScript(chart, ChartFormat::svg));
  const std::optional<std::string> png = runGnuplot(gnuplotScript(chart, ChartFormat::png));
  std::vector<std::pair<std::string, std::string>> texts = {{"memory.csv", toCsv(memoryCsv(points))}};
  if (svg) texts.emplace_back("memory.svg", *svg);
  if (png) texts.emplace_back("memory.png", *png);
  texts.emplace_back("index.html", memoryPage(points, scenes, svg));
  std::vector<AtomicFile> files;
  for (const auto& [name, text] : texts) files.emplace_back(folder / name).write(text);
  for (AtomicFile& file : files) file.commit();
  if (svg) return;
  // Charts of an earlier run would not be those of this table.
  for (const char* name : {"memory.svg", "memory.png"}) std::filesystem::remove(folder / name);
  std::cerr << "warning: gnuplot is not installed (Debian: gnuplot-nox); there are no charts\n";
}

}  // namespace

double singleOverThree(const Scene& scene) {
  const glm::dvec3 extent = scene.bounds().extent();
  // A texel's area as each axis sees it is in proportion to the bounds' face.
  const glm::dvec3 size = glm::max(extent, 2e-3 * std::max({extent.x, extent.y, extent.z}));
  const glm::dvec3 face(size.y * size.z, size.z * size.x, size.x * size.y);
  double single = 0, three = 0;
  for (const Triangle& triangle : scene.triangles) {
    const auto corner = [&](std::size_t i) { return glm::dvec3(scene.vertices[triangle.vertices[i]].position); };
    const glm::dvec3 normal = glm::abs(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
    const glm::dvec3 fragments = normal / face;
    const int axis = normal.x >= normal.y && normal.x >= normal.z ? 0 : normal.y >= normal.z ? 1 : 2;
    single += fragments[axis];
    three += fragments.x + fragments.y + fragments.z;
  }
  return three > 0 ? single / three : 1;
}

void runMemory(const Request& request) {
  const std::vector<BenchScene> scenes = loadScenes(request);
  Workbench bench(request);
  const OutputFolder folder(request.folder);
  Measurement measurement(request, scenes, folder, bench);
  const std::vector<Json> points = measurement.run();
  std::vector<ScenePicture> pictures;
  for (const BenchScene& scene : scenes) pictures.push_back({scene.name, measurement.picture(scene)});
  writeReport(folder, points, pictures);
  std::cout << toText(memorySummary(points));
  for (const Json& point : points)
    if (point["lost_fragments"] != 0)
      std::cerr << "warning: " << point["scene"]["file"].get<std::string>() << ", "
                << point["preset"].get<std::string>() << ": " << point["lost_fragments"]
                << " fragments found no room in the A-buffer\n";
}

}  // namespace halfsilver::bench
