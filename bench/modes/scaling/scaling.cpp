#include "bench/modes/scaling/scaling.h"

#include <chrono>
#include <cmath>
#include <memory>
#include <new>
#include <string_view>
#include <utility>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include <halfsilver/methods.h>
#include "bench/harness/method_presets.h"
#include "bench/modes/scaling/report.h"
#include "bench/modes/scaling/scenes.h"
#include "bench/report/text.h"

namespace halfsilver::bench {
namespace {

// Names of the scenes.
constexpr const char* kFinerTriangles = "finer triangles";
constexpr const char* kMoreObjects = "more objects";

constexpr std::size_t kTriangles = 31623, kQuickTriangles = 10000;  // if something else grows
constexpr int kTexels = 256;                                        // along an axis
constexpr int kFrames = 3;                                          // of a short point
constexpr double kShort = 1;                                        // seconds, at most

struct SceneSpec {
  Model (*make)(std::size_t triangles, std::size_t lights) = subdividedScene;
  std::size_t triangles = 0, lights = 1;

  bool operator==(const SceneSpec&) const = default;
};

// What is drawn for a value of an axis.
struct Case {
  const char* axis;  // see kScalingAxes
  double value = 0;
  SceneSpec scene;
  Size size;
  std::optional<float> fraction = {};  // of all pixels, instead of the reflective ones
  int bounces = 1;
};

std::vector<Case> cases(const Request& request) {
  const bool quick = request.quick;
  const SceneSpec usual{subdividedScene, quick ? kQuickTriangles : kTriangles, 1};
  std::vector<Case> all;
  const auto add = [&](const char* axis, double value) -> Case& {
    all.push_back({axis, value, usual, request.size});
    return all.back();
  };
  for (const auto& [axis, make] : {std::pair("finer", &subdividedScene), {"more", &crowdedScene}})
    for (int half = 8; half <= (quick ? 10 : 14); ++half) {
      const double triangles = std::round(std::pow(10.0, 0.5 * half));
      add(axis, triangles).scene = {make, static_cast<std::size_t>(triangles), 1};
    }
  for (const Size& size : {Size{80, 45}, {160, 90}, {320, 180}, {640, 360}, {1280, 720}, {1920, 1080}})
    if (!quick || size.width <= 320) add("pixels", 1.0 * size.width * size.height).size = size;
  for (const int parts : {32, 16, 8, 4, 2, 1})
    if (!quick || parts == 16 || parts == 4 || parts == 1)
      add("coverage", 100.0 / parts).fraction = 1.0f / static_cast<float>(parts);
  for (const std::size_t lights : {1, 2, 4, 8, 16, 32, 64})
    if (!quick || lights <= 4) add("lights", static_cast<double>(lights)).scene.lights = lights;
  for (const int bounces : {1, 2, 4, 8, 16})
    if (!quick || bounces <= 4) add("bounces", bounces).bounces = bounces;
  return all;
}

bool growsTriangles(const Case& point) {
  const std::string_view axis = point.axis;
  return axis == "finer" || axis == "more";
}

// The same structure at every size: the papers' voxels for small scenes, and so few texels that the fixed cost of a
// frame does not hide the growth.
Settings settingsOf(const std::string& preset, bool quick, const Case& point) {
  Settings settings = presetSettings(preset, quick, 0);
  if (settings.trace.method == "none") throw Error(ErrorKind::usage, "the preset " + preset + " traces nothing");
  if (methodInfo(settings.trace.method).fixedResolution) settings.abuffer.resolution = kTexels;
  settings.select.mode = point.fraction ? SelectMode::all : SelectMode::reflective;
  settings.select.fraction = point.fraction.value_or(1.0f);
  settings.trace.bounces = point.bounces;
  settings.identity.keep = false;  // as for a moving scene
  return settings;
}

// Draws points; successive points of the same scene share it.
class Measurement {
 public:
  Measurement(Workbench& bench, const OutputFolder& folder) : bench_(&bench), folder_(&folder) {}

  // Does not make the scene.
  ScalingKey key(const Case& point, const std::string& preset, const Settings& settings) const {
    const SceneSpec& spec = point.scene;
    const PointKey<> key = pointKey(bench_->describe({}, settings), {}, preset);
    return {{key.version, key.device, {nameOf(spec), spec.triangles, spec.lights}, settings, point.size, preset},
            point.axis,
            point.value};
  }

  // Also of a point that fails, with the message.
  ScalingResult measure(const Case& point, const Settings& settings, bool keepsPicture) {
    ScalingResult result;
    try {
      const BenchScene& scene = sceneOf(point.scene);
      bench_->load(scene);
      result.triangles = scene.model.scene.triangles.size();
      // Making and loading the scene is no work of the method.
      const auto start = std::chrono::steady_clock::now();
      RunStatistics run = bench_->describe(scene, settings);
      run.width = point.size.width;
      run.height = point.size.height;
      bench_->draw(scene, run);
      result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      if (result.seconds < kShort) bench_->draw(scene, run, kFrames);
      result.frame = timedFrame(run);
      if (keepsPicture) savePicture(*folder_, scene.name, *bench_);
    } catch (const Error& error) {
      result.failed = error.what();
    } catch (const std::bad_alloc&) {
      result.failed = "out of memory";
    }
    if (result.failed) bench_->forget();
    return result;
  }

 private:
  static std::string nameOf(const SceneSpec& spec) {
    return spec.make == crowdedScene ? kMoreObjects : kFinerTriangles;
  }

  const BenchScene& sceneOf(const SceneSpec& spec) {
    if (spec == spec_) return scene_;
    bench_->forget();
    spec_ = {};
    scene_ = {};
    scene_.model = spec.make(spec.triangles, spec.lights);
    scene_.name = nameOf(spec);
    scene_.camera = scene_.model.scene.cameras.front();
    scene_.diagonal = scene_.model.scene.bounds().diagonal();
    spec_ = spec;
    return scene_;
  }

  Workbench* bench_;
  const OutputFolder* folder_;
  SceneSpec spec_;
  BenchScene scene_;
};

Plan planScaling(const Setup& setup) {
  const std::vector<std::string> presets = chosenPresets(setup.request, methodPresets(setup.request.quick, 0, false));
  const auto measurement = std::make_shared<Measurement>(setup.bench, setup.folder);
  const double timeLimit = setup.request.timeLimit;
  std::vector<Task<ScalingPoint>> tasks;
  for (const Case& point : cases(setup.request))
    for (const std::string& preset : presets) {
      const Settings settings = settingsOf(preset, setup.request.quick, point);
      const bool keepsPicture = preset == presets.front() && growsTriangles(point) &&
                                point.scene.triangles == (setup.request.quick ? kQuickTriangles : kTriangles);
      tasks.push_back({.key = measurement->key(point, preset, settings),
                       .label = preset + ", " + std::string(point.axis) + ' ' + number(point.value, 0),
                       .work = workOf(4 * point.bounces, point.scene.triangles),
                       .measure = [measurement, point, settings,
                                   keepsPicture] { return measurement->measure(point, settings, keepsPicture); },
                       .series = preset + ", " + point.axis,
                       .ends = [timeLimit](const ScalingPoint& result) { return stops(result, timeLimit); }});
    }
  const auto report = [&folder = setup.folder, timeLimit](const std::vector<ScalingPoint>& points) {
    const ScalingSeries series = scalingSeries(points);
    const ChartFiles chart = drawChart(scalingChart(series));
    std::vector<Figure> pictures;
    for (const char* name : {kFinerTriangles, kMoreObjects}) pictures.push_back({readPicture(folder, name), name});
    return Report{.title = "How cost and memory grow",
                  .tables = {{"scaling", scalingCsv(series)},
                             {"scaling_exponents", exponentsCsv(series)},
                             {"scaling_limits", limitsTable(series, timeLimit)}},
                  .chart = chart,
                  .body = scalingBody(series, pictures, timeLimit, chart.svg),
                  .summary = exponentsTable(series)};
  };
  return makePlan<ScalingPoint>(std::move(tasks), report);
}

}  // namespace

Mode scalingMode() {
  return {.name = "scaling",
          .description =
              "Cost and memory against triangles, pixels, coverage, lights and bounces, and where each method ends",
          .takesPresets = true,
          .takesTimeLimit = true,
          .bringsOwnScenes = true,
          .plan = planScaling};
}

}  // namespace halfsilver::bench
