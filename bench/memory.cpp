#include "bench/memory.h"

#include <algorithm>
#include <memory>
#include <utility>

#include <halfsilver/io.h>
#include "apps/drawing.h"
#include "bench/memory_report.h"
#include "bench/points.h"
#include "bench/report.h"
#include "bench/tasks.h"
#include "bench/truth.h"
#include "bench/workbench.h"

namespace halfsilver::bench {
namespace {

using Json = nlohmann::ordered_json;

struct Variant {
  std::string name;
  Settings settings;
};

// The systems that are compared. Kastrati's own A-buffer in all three axes is there, too: it differs from his in
// nothing but the number of A-buffers, while Hu's has linked lists.
std::vector<Variant> variants(bool quick, std::size_t triangles, bool exact) {
  std::vector<Variant> all;
  Settings settings = presetSettings(kDefaultPreset, quick, triangles);
  all.push_back({kDefaultPreset, settings});
  const Settings kastrati = presetSettings("kastrati2017", quick, triangles);
  all.push_back({"kastrati2017", kastrati});
  settings = kastrati;
  settings.attributes.buffers = Buffers::three;
  all.push_back({"kastrati2017 three", settings});
  settings = presetSettings("hu2014", quick, triangles);
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

class Measurement {
 public:
  Measurement(const OutputFolder& folder, Workbench& bench) : folder_(&folder), bench_(&bench), truth_(bench) {}

  // Adds the measured members to the point.
  void measure(const BenchScene& scene, const Variant& variant, Json& point) {
    RunStatistics run = bench_->describe(scene, variant.settings);
    bench_->draw(scene, run);
    addMeasured(point, run);
    point["single_over_three"] = singleOverThree(scene.model.scene);
    point["error"] = nullptr;
    if (variant.name == kDefaultPreset) keepPicture(*folder_, scene.name, *bench_);
    if (exactFactory(scene.model.scene, 0)) {
      const Image layers = bench_->layers();
      const Image& truth = truth_.of(scene, variant.settings.select.mode).layers;
      point["error"] = toJson(compareImages({layers, true, scene.diagonal}, {truth, true, scene.diagonal}));
    }
  }

 private:
  const OutputFolder* folder_;
  Workbench* bench_;
  Truth truth_;
};

Plan planMemory(const Setup& setup) {
  const auto measurement = std::make_shared<Measurement>(setup.folder, setup.bench);
  Plan plan;
  for (const BenchScene& scene : setup.scenes) {
    const std::size_t triangles = scene.model.scene.triangles.size();
    const bool exact = static_cast<bool>(exactFactory(scene.model.scene, 0));
    for (const Variant& variant : variants(setup.request.quick, triangles, exact)) {
      Task task{pointKey(setup.bench.describe(scene, variant.settings), scene), scene.name + ", " + variant.name,
                workOf(3, triangles),
                [measurement, &scene, variant](Json& point) { measurement->measure(scene, variant, point); }};
      task.key["preset"] = variant.name;
      plan.tasks.push_back(std::move(task));
    }
  }
  plan.report = [&folder = setup.folder, &scenes = setup.scenes](const PointList& points) {
    const ChartFiles chart = drawChart(memoryChart(points));
    return Report{.title = "What reflections take in memory",
                  .tables = {{"memory", memoryCsv(points)}},
                  .chart = chart,
                  .body = memoryBody(points, readPictures(folder, scenes), chart.svg),
                  .summary = memorySummary(points),
                  .warnings = lostFragments(points)};
  };
  return plan;
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

Mode memoryMode() {
  return {.name = "memory",
          .description = "What each method's structure takes, and how wrong its hits are",
          .plan = planMemory};
}

}  // namespace halfsilver::bench
