#include "bench/modes/speed/speed.h"

#include <algorithm>
#include <memory>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "apps/drawing.h"
#include "bench/modes/speed/lanes.h"
#include "bench/modes/speed/report.h"

namespace halfsilver::bench {
namespace {

constexpr int kFrames = 7, kQuickFrames = 2;  // of each kind
constexpr float kMove = 0.05f;                // meters
constexpr std::size_t kPercent = 100;

std::vector<std::string> presetsOf(const Request& request, bool exact) {
  std::vector<std::string> presets = {kDefaultPreset, "bvh", "kastrati2017"};
  if (exact) presets.emplace_back(kReference);
  return chosenPresets(request, presets);
}

// Vertices of so many percent of the triangles, which stand together in the scene's order.
std::vector<VertexRange> movingVertices(const Scene& scene, std::size_t share) {
  const std::size_t all = scene.triangles.size();
  const std::size_t count = std::min(all, std::max<std::size_t>(1, all * share / kPercent));
  const std::size_t first = std::min(all / 2, all - count);
  std::set<std::uint32_t> vertices;
  for (std::size_t i = first; i < first + count; ++i)
    vertices.insert(scene.triangles[i].vertices.begin(), scene.triangles[i].vertices.end());
  std::vector<VertexRange> ranges;
  for (const std::uint32_t vertex : vertices)
    if (!ranges.empty() && ranges.back().first + ranges.back().count == vertex)
      ++ranges.back().count;
    else
      ranges.push_back({vertex, 1});
  return ranges;
}

class Measurement {
 public:
  Measurement(bool quick, const OutputFolder& folder, Workbench& bench)
      : frames_(quick ? kQuickFrames : kFrames), folder_(&folder), bench_(&bench) {}

  double frames() const { return 6.0 * frames_ + 6; }

  SpeedResult measure(BenchScene& scene, const Settings& settings) {
    RunStatistics run = bench_->describe(scene, settings);
    bench_->draw(scene, run);
    if (settings.trace.method == Settings().trace.method) savePicture(*folder_, scene.name, *bench_);
    SpeedResult result;
    result.first = costOf(scene, run, [&] { bench_->startOver(scene); });
    double cpu = 0;
    result.warm = costOf(
        scene, run, [] {}, &cpu);
    static_cast<FrameRecord&>(result) = frameRecord(run);
    addRates(run, cpu, result);
    result.camera = costOfCamera(scene, run);
    result.object = costOfMoves(scene, run, 1);
    result.tenth = costOfMoves(scene, run, 10);
    result.everything = costOfMoves(scene, run, kPercent);
    result.search = searchOf(scene, settings);
    return result;
  }

 private:
  // Frames before each of which `prepare` is called. `cpu`: the least milliseconds that all threads spent on the trace.
  template <class Prepare>
  FrameCost costOf(BenchScene& scene, RunStatistics& run, const Prepare& prepare, double* cpu = nullptr) {
    StageTimes times;
    FrameCost cost;
    for (int frame = 0; frame < frames_; ++frame) {
      prepare();
      bench_->drawNext(scene, run);
      times.add(run.report.times);
      const GlWork& work = bench_->lastWork();
      cost.dispatches = std::max(cost.dispatches, work.dispatches);
      cost.draws = std::max(cost.draws, work.draws);
      cost.waits = std::max(cost.waits, work.waits);
      const auto trace = work.cpu.find("trace");
      if (cpu && trace != work.cpu.end()) *cpu = *cpu > 0 ? std::min(*cpu, trace->second) : trace->second;
    }
    run.stages = times.summarize();
    cost.times = timedFrame(run).times;
    return cost;
  }

  FrameCost costOfCamera(BenchScene& scene, RunStatistics& run) {
    const Camera before = scene.camera;
    const glm::vec3 view = before.target - before.eye;
    const glm::vec3 side = kMove * glm::normalize(glm::cross(view, before.up));
    const FrameCost cost = costOf(scene, run, [&] {
      scene.camera.eye += side;
      scene.camera.target += side;
    });
    scene.camera = before;
    return cost;
  }

  FrameCost costOfMoves(BenchScene& scene, RunStatistics& run, std::size_t share) {
    const std::vector<VertexRange> moving = movingVertices(scene.model.scene, share);
    const std::vector<Vertex> before = scene.model.scene.vertices;
    const FrameCost cost = costOf(scene, run, [&] {
      for (const VertexRange& range : moving)
        for (std::uint32_t i = 0; i < range.count; ++i) scene.model.scene.vertices[range.first + i].position.y += kMove;
      bench_->moveVertices(scene, moving);
    });
    scene.model.scene.vertices = before;
    bench_->moveVertices(scene, moving);
    return cost;
  }

  static void addRates(const RunStatistics& run, double cpu, SpeedResult& result) {
    const auto rays = static_cast<double>(run.report.selected);
    const double trace = result.warm.times.trace.min;
    if (trace > 0) result.raysPerSecond = 1e3 * rays / trace;
    // The CPU's own rays are traced by threads that no debug group sees.
    const double exact = run.settings.trace.method == "exact" ? trace * std::thread::hardware_concurrency() : 0;
    const double cores = exact > 0 ? exact : run.device.software ? cpu : 0;
    if (cores > 0) result.raysPerCoreSecond = 1e3 * rays / cores;
    const auto triangles = static_cast<double>(run.triangles);
    if (triangles == 0) return;
    result.buildMsPerMillion = 1e6 * (result.first.times.voxelize.min + result.first.times.build.min) / triangles;
    result.bytesPerTriangle = static_cast<double>(run.report.memory.structureTotal) / triangles;
  }

  std::optional<SearchCounts> searchOf(BenchScene& scene, Settings settings) {
    settings.trace.countWork = true;
    settings.trace.bounces = 1;  // of first rays
    RunStatistics run = bench_->describe(scene, settings);
    bench_->draw(scene, run);
    const std::vector<RayWork> work = bench_->rayWork();
    if (work.empty()) return std::nullopt;
    SearchCounts counts;
    for (const RayWork& ray : work) {
      counts.steps += ray.steps;
      counts.tests += ray.tests;
      counts.maxTests = std::max<std::uint64_t>(counts.maxTests, ray.tests);
    }
    counts.steps /= static_cast<double>(work.size());
    counts.tests /= static_cast<double>(work.size());
    counts.lanesOf8 = lanesAtWork(work, 8);
    counts.lanesOf32 = lanesAtWork(work, 32);
    return counts;
  }

  int frames_;
  const OutputFolder* folder_;
  Workbench* bench_;
};

Plan planSpeed(const Setup& setup) {
  const auto measurement = std::make_shared<Measurement>(setup.request.quick, setup.folder, setup.bench);
  std::vector<Task<SpeedPoint>> tasks;
  for (BenchScene& scene : setup.scenes) {
    const std::size_t triangles = scene.model.scene.triangles.size();
    const bool exact = static_cast<bool>(exactFactory(scene.model.scene, 0));
    for (const std::string& preset : presetsOf(setup.request, exact)) {
      const Settings settings = presetSettings(preset, setup.request.quick, triangles);
      tasks.push_back({.key = pointKey(setup.bench.describe(scene, settings), scene, preset),
                       .label = scene.name + ", " + preset,
                       .work = workOf(measurement->frames(), triangles),
                       .measure = [measurement, &scene, settings] { return measurement->measure(scene, settings); }});
    }
  }
  const auto report = [&folder = setup.folder, &scenes = setup.scenes](const std::vector<SpeedPoint>& points) {
    const ChartFiles warm = drawChart(speedChart(points, FrameKind::warm));
    const ChartFiles first = drawChart(speedChart(points, FrameKind::first));
    const auto rays = [](const SpeedPoint& point) { return ", " + std::to_string(point.pixels.selected) + " rays"; };
    return Report{.title = "What rays take in time",
                  .tables = {{"speed", speedCsv(points)}},
                  .chart = warm,
                  .body = speedBody(points, sceneFigures(folder, scenes, points, rays), warm.svg, first.svg),
                  .summary = speedSummary(points),
                  .warnings = lostFragments(points)};
  };
  return makePlan<SpeedPoint>(std::move(tasks), report);
}

}  // namespace

Mode speedMode() {
  return {.name = "speed",
          .description = "Rays per second, what each ray does, time per stage, moves and waits",
          .takesPresets = true,
          .plan = planSpeed};
}

}  // namespace halfsilver::bench
