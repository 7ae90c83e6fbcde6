#include "bench/scaling.h"

#include <chrono>
#include <cmath>
#include <memory>
#include <new>
#include <string_view>
#include <utility>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include <halfsilver/methods.h>
#include "bench/scaling_report.h"
#include "bench/scaling_scenes.h"

namespace halfsilver::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kTriangles = 31623, kQuickTriangles = 10000;  // where something else grows
constexpr int kTexels = 256;                                        // along an axis
constexpr int kFrames = 3;                                          // of a point that takes less than this
constexpr double kShort = 1;                                        // seconds

struct SceneSpec {
  Model (*make)(std::size_t triangles, std::size_t lights) = subdividedScene;
  std::size_t triangles = 0, lights = 1;

  bool operator==(const SceneSpec&) const = default;
};

// A value of an axis: what is drawn there.
struct Case {
  const char* axis;  // see scalingAxes()
  double value = 0;
  SceneSpec scene;
  Size size;
  std::optional<float> fraction = {};  // of all pixels, in place of those that reflect
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

// The same structure at every size: the papers' voxels for small scenes, and texels so few that what a frame takes
// anyway does not hide what grows.
Settings settingsOf(const std::string& preset, bool quick, const Case& point) {
  Settings settings = presetSettings(preset, quick, 0);
  if (settings.trace.method == "none") throw Error(ErrorKind::usage, "the preset " + preset + " traces nothing");
  if (methodInfo(settings.trace.method).fixedResolution) settings.abuffer.resolution = kTexels;
  settings.select.mode = point.fraction ? SelectMode::all : SelectMode::reflective;
  settings.select.fraction = point.fraction.value_or(1.0f);
  settings.trace.bounces = point.bounces;
  settings.identity.keep = false;  // what a frame costs whose scene moves
  return settings;
}

// Draws points; the scene stays while the next point has the same.
class Measurement {
 public:
  Measurement(Workbench& bench, const OutputFolder& folder) : bench_(&bench), folder_(&folder) {}

  // What it is that is drawn, without making the scene.
  Json key(const Case& point, const std::string& preset, const Settings& settings) const {
    BenchScene named;
    named.name = nameOf(point.scene);
    Json key = pointKey(bench_->describe(named, settings), named);
    key["scene"] = {{"file", named.name}, {"triangles_wanted", point.scene.triangles}, {"lights", point.scene.lights}};
    key["size"] = {point.size.width, point.size.height};
    key["axis"] = point.axis;
    key["value"] = point.value;
    key["preset"] = preset;
    return key;
  }

  // Adds the measured members to the point, or what went wrong.
  void measure(const Case& point, const Settings& settings, bool keepsPicture, Json& result) {
    try {
      const BenchScene& scene = sceneOf(point.scene);
      bench_->load(scene);
      result["triangles"] = scene.model.scene.triangles.size();
      // Making and loading the scene is no work of the method.
      const auto start = std::chrono::steady_clock::now();
      const auto seconds = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      };
      RunStatistics run = bench_->describe(scene, settings);
      run.width = point.size.width;
      run.height = point.size.height;
      bench_->draw(scene, run);
      result["seconds"] = seconds();
      if (seconds() < kShort) bench_->draw(scene, run, kFrames);
      addMeasured(result, run);
      addTimes(result, run);
      if (keepsPicture) keepPicture(*folder_, scene.name, *bench_);
    } catch (const Error& error) {
      fail(result, error.what());
    } catch (const std::bad_alloc&) {
      fail(result, "out of memory");
    }
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

  void fail(Json& result, const std::string& why) {
    bench_->forget();
    result["failed"] = why;
  }

  Workbench* bench_;
  const OutputFolder* folder_;
  SceneSpec spec_;
  BenchScene scene_;
};

Plan planScaling(const Setup& setup) {
  const std::vector<std::string> presets = chosenPresets(setup.request, {kDefaultPreset, "kastrati2017", "hu2014"});
  const auto measurement = std::make_shared<Measurement>(setup.bench, setup.folder);
  const double timeLimit = setup.request.timeLimit;
  Plan plan;
  for (const Case& point : cases(setup.request))
    for (const std::string& preset : presets) {
      const Settings settings = settingsOf(preset, setup.request.quick, point);
      const bool keepsPicture = preset == presets.front() && growsTriangles(point) &&
                                point.scene.triangles == (setup.request.quick ? kQuickTriangles : kTriangles);
      plan.tasks.push_back(
          {.key = measurement->key(point, preset, settings),
           .label = preset + ", " + std::string(point.axis) + ' ' + number(point.value, 0),
           .work = workOf(4 * point.bounces, point.scene.triangles),
           .measure = [measurement, point, settings,
                       keepsPicture](Json& result) { measurement->measure(point, settings, keepsPicture, result); },
           .series = preset + ", " + point.axis,
           .ends = [timeLimit](const Json& result) { return stops(result, timeLimit); }});
    }
  plan.report = [&folder = setup.folder, timeLimit](const PointList& points) {
    const ScalingSeries series = scalingSeries(points);
    const ChartFiles chart = drawChart(scalingChart(series));
    std::vector<ScenePicture> pictures;
    for (const char* name : {kFinerTriangles, kMoreObjects})
      pictures.push_back({name, readBytes(folder / pictureFile(name))});
    return Report{.title = "How cost and memory grow",
                  .tables = {{"scaling", scalingCsv(series)},
                             {"scaling_exponents", exponentsCsv(series)},
                             {"scaling_limits", limitsTable(series, timeLimit)}},
                  .chart = chart,
                  .body = scalingBody(series, pictures, timeLimit, chart.svg),
                  .summary = exponentsTable(series)};
  };
  return plan;
}

}  // namespace

Mode scalingMode() {
  return {.name = "scaling",
          .description = "Cost and memory against triangles, pixels, coverage, lights and bounces, and where it ends",
          .takesPresets = true,
          .takesTimeLimit = true,
          .bringsOwnScenes = true,
          .plan = planScaling};
}

}  // namespace halfsilver::bench
