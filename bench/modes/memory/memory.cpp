#include "bench/modes/memory/memory.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <halfsilver/io.h>
#include "apps/drawing.h"
#include "bench/harness/method_presets.h"
#include "bench/harness/truth.h"
#include "bench/modes/memory/report.h"
#include "bench/report/text.h"

namespace halfsilver::bench {
namespace {

struct Variant {
  std::string name;
  Settings settings;
};

// All methods. Kastrati's own A-buffer along all three axes is one of them: it differs from his only in the number of
// A-buffers, while Hu's has linked lists; both have the texels that Kastrati's table gives both. A preset that traces
// all pixels is measured on the reflective ones, too.
std::vector<Variant> variants(bool quick, std::size_t triangles, bool exact) {
  const int texels = presetSettings("kastrati2017", quick, triangles).abuffer.resolution;
  std::vector<Variant> all;
  for (const std::string& preset : methodPresets(quick, triangles, exact)) {
    ReflectivePreset reflective = reflectivePreset(preset, quick, triangles);
    if (preset == "hu2014") reflective.settings.abuffer.resolution = texels;
    all.push_back({reflective.name, reflective.settings});
    if (reflective.name != preset) {
      all.push_back({preset + " all", reflective.settings});
      all.back().settings.select.mode = SelectMode::all;
    }
    if (preset != "kastrati2017") continue;
    all.push_back({"kastrati2017 three", reflective.settings});
    all.back().settings.attributes.buffers = Buffers::three;
  }
  return all;
}

class Measurement {
 public:
  Measurement(const OutputFolder& folder, Workbench& bench) : folder_(&folder), bench_(&bench), truth_(bench) {}

  MemoryResult measure(const BenchScene& scene, const Variant& variant) {
    RunStatistics run = bench_->describe(scene, variant.settings);
    bench_->draw(scene, run);
    MemoryResult result{frameRecord(run), singleOverThree(scene.model.scene), {}};
    if (variant.name == kDefaultPreset) savePicture(*folder_, scene.name, *bench_);
    if (exactFactory(scene.model.scene, 0)) {
      const Image layers = bench_->layers();
      const Image& truth = truth_.of(scene, variant.settings.select.mode).layers;
      result.error = errorOf(layers, truth, scene.diagonal);
    }
    return result;
  }

 private:
  const OutputFolder* folder_;
  Workbench* bench_;
  Truth truth_;
};

Plan planMemory(const Setup& setup) {
  const auto measurement = std::make_shared<Measurement>(setup.folder, setup.bench);
  std::vector<Task<MemoryPoint>> tasks;
  for (const BenchScene& scene : setup.scenes) {
    const std::size_t triangles = scene.model.scene.triangles.size();
    const bool exact = static_cast<bool>(exactFactory(scene.model.scene, 0));
    for (const Variant& variant : variants(setup.request.quick, triangles, exact))
      tasks.push_back({.key = pointKey(setup.bench.describe(scene, variant.settings), scene, variant.name),
                       .label = scene.name + ", " + variant.name,
                       .work = workOf(3, triangles),
                       .measure = [measurement, &scene, variant] { return measurement->measure(scene, variant); }});
  }
  const auto report = [&folder = setup.folder, &scenes = setup.scenes](const std::vector<MemoryPoint>& points) {
    const ChartFiles chart = drawChart(memoryChart(points));
    const auto coverage = [](const MemoryPoint& point) {
      return ", " + percent(point.pixels.coverage) + " of the pixels reflect";
    };
    return Report{.title = "What reflections take in memory",
                  .tables = {{"memory", memoryCsv(points)}},
                  .chart = chart,
                  .body = memoryBody(points, sceneFigures(folder, scenes, points, coverage), chart.svg),
                  .summary = memorySummary(points),
                  .warnings = lostFragments(points)};
  };
  return makePlan<MemoryPoint>(std::move(tasks), report);
}

}  // namespace

double singleOverThree(const Scene& scene) {
  const glm::dvec3 extent = scene.bounds().extent();
  // Along each axis a texel's area is proportional to that face of the bounds.
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

Mode memoryMode() {
  return {.name = "memory",
          .description = "Memory of each method's structure, and how wrong its hits are",
          .plan = planMemory};
}

}  // namespace halfsilver::bench
