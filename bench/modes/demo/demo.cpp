#include "bench/modes/demo/demo.h"

#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <istream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include "apps/demo_module.h"
#include "bench/harness/fields.h"
#include "bench/harness/output_folder.h"
#include "bench/harness/tasks.h"
#include "bench/modes/demo/report.h"
#include "bench/report/page.h"
#include "bench/report/report.h"

namespace halfsilver::bench {
namespace {

constexpr int kFrames = 600, kQuickFrames = 6;
constexpr const char* kAuto = "auto";  // what the demo draws with if it is not told otherwise

std::string readFile(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error(ErrorKind::badInput, file.string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(stream), {}};
}

// FNV-1a.
std::uint64_t hashOf(const std::string& bytes) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  return hash;
}

Settings settingsOf(const std::string& preset) {
  Settings settings;
  if (preset == kAuto)
    settings.trace.method = kAuto;
  else
    applyPreset(settings, preset);
  return settings;
}

DemoKey keyOf(const Setup& setup, const std::string& preset) {
  const PointKey<> base = pointKey(setup.bench.describe({}, settingsOf(preset)), {}, preset);
  DemoKey key;
  key.version = base.version;
  key.device = base.device;
  key.settings = base.settings;
  key.size = base.size;
  key.preset = preset;
  key.scene = {std::filesystem::path(setup.request.replay).filename().string(), hashOf(readFile(setup.request.replay))};
  key.framesWanted = setup.request.frames.value_or(setup.request.quick ? kQuickFrames : kFrames);
  key.frameTime = setup.request.frameTime;
  return key;
}

// The demo has a context of its own, so it gets a thread of its own.
void play(const demo::Request& request) {
  std::exception_ptr error;
  std::thread([&] {
    try {
      runDemo(request);
    } catch (...) {
      error = std::current_exception();
    }
  }).join();
  if (error) std::rethrow_exception(error);
}

std::string pictureOf(const DemoKey& key) { return key.scene.file + " " + key.preset; }

DemoResult measure(const Request& request, const OutputFolder& folder, const DemoKey& key) {
  demo::Request demo;
  demo.view.size = std::to_string(key.size.width) + "x" + std::to_string(key.size.height);
  demo.view.context = request.context;
  demo.view.preset = key.preset == kAuto ? "" : key.preset;
  demo.replay = request.replay;
  demo.frames = key.framesWanted;
  if (key.frameTime > 0) demo.frameTime = key.frameTime;
  demo.screenshot = (folder / pictureFile(pictureOf(key))).string();
  const std::filesystem::path lines = folder / (pictureFile(pictureOf(key)) + ".stats");
  demo.stats = lines.string();
  play(demo);
  DemoResult result;
  std::istringstream stream(readFile(lines));
  result.frames = readFrames(stream, lines.string());
  std::filesystem::remove(lines);  // the points hold it
  return result;
}

Plan planDemo(const Setup& setup) {
  std::vector<Task<DemoPoint>> tasks;
  for (const std::string& preset : chosenPresets(setup.request, {kAuto})) {
    const DemoKey key = keyOf(setup, preset);
    tasks.push_back({.key = key,
                     .label = key.scene.file + ", " + preset,
                     .work = static_cast<double>(key.framesWanted),
                     .measure = [&setup_request = setup.request, &folder = setup.folder, key] {
                       return measure(setup_request, folder, key);
                     }});
  }
  const auto report = [&folder = setup.folder](const std::vector<DemoPoint>& points) {
    const ChartFiles chart = drawChart(demoChart(points));
    std::vector<Figure> pictures;
    for (const DemoPoint& point : points)
      pictures.push_back({readPicture(folder, pictureOf(point)), point.preset + ", the last frame"});
    return Report{.title = "The game",
                  .tables = {{"demo", demoCsv(points)}},
                  .chart = chart,
                  .body = demoBody(points, pictures, chart.svg),
                  .summary = demoTable(points)};
  };
  return makePlan<DemoPoint>(std::move(tasks), report);
}

}  // namespace

std::vector<DemoFrame> readFrames(std::istream& lines, const std::string& file) {
  std::vector<DemoFrame> frames;
  for (std::string line; std::getline(lines, line);) {
    try {
      frames.push_back(fromJson<DemoFrame>(nlohmann::ordered_json::parse(line, nullptr, false)));
    } catch (const Error&) {
      throw Error(ErrorKind::badInput,
                  file + ", line " + std::to_string(frames.size() + 1) + ": not the figures of a frame in JSON");
    }
  }
  return frames;
}

Mode demoMode() {
  return {.name = "demo",
          .description = "A recording of the game: frame times, memory and coverage, frame by frame",
          .takesPresets = true,
          .takesReplay = true,
          .plan = planDemo};
}

}  // namespace halfsilver::bench
