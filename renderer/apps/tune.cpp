#include <algorithm>
#include <cstdio>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <halfsilver/context.h>
#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include <halfsilver/renderer.h>
#include "apps/commands.h"
#include "apps/drawing.h"
#include "apps/offscreen.h"
#include "apps/progress.h"
#include "apps/statistics.h"
#include "apps/tune_report.h"
#include "io/atomic_file.h"

namespace halfsilver {
namespace {

// A candidate slower than this many times the fastest one that is accurate enough (or the fastest of all, until one is)
// ends its ladder: the larger ones are not worth a try.
constexpr double kTooSlow = 8;

struct TuneRequest {
  ViewRequest view;
  std::string output = "tuned.toml";
  double maxError = 5e-4;
  int repeat = 3;
};

// Every frame builds everything from scratch. Shadows do not change what a ray hits, and would be redrawn with every
// change of the settings.
Settings measuredSettings(Settings settings) {
  settings.identity.keep = false;
  settings.shadow.resolution = 16;
  settings.shadow.skyDirections = 0;
  return settings;
}

// Median time per frame spent on the structure; infinite if the driver gave no valid time.
double structureMilliseconds(const StageTimes& times) {
  double sum = 0;
  for (const StageSummary& stage : times.summarize()) {
    if (stage.stage != "voxelize" && stage.stage != "build" && stage.stage != "trace") continue;
    sum += stage.runs == 0 && stage.rejected > 0 ? std::numeric_limits<double>::infinity() : stage.median;
  }
  return sum;
}

// Draws one view of a scene with different settings.
class Measurement {
 public:
  Measurement(Renderer& renderer, const Camera& camera, const Target& target, double diagonal)
      : renderer_(renderer), camera_(camera), target_(target), diagonal_(diagonal) {}

  // Traces the same rays exactly. Returns the report of that frame.
  FrameReport drawReference(Settings settings) {
    settings.trace.method = "exact";
    renderer_.render(camera_, measuredSettings(settings), target_);
    reference_ = renderer_.readLayers();
    return renderer_.report();
  }

  // Draws a frame to warm up and one that is measured. Throws Error (failed) if the structure is too small.
  FrameReport draw(const Settings& settings) {
    const Settings measured = measuredSettings(settings);
    FrameReport report;
    drawFirstFrame(renderer_, camera_, measured, target_, report);
    renderer_.render(camera_, measured, target_);
    report = renderer_.report();
    if (report.lostFragments > 0)
      throw Error(ErrorKind::failed, std::to_string(report.lostFragments) + " fragments did not fit into the A-buffer");
    return report;
  }

  // Of the last frame.
  double error() const { return compareLayers(renderer_.readLayers(), reference_, diagonal_).hitError; }

 private:
  Renderer& renderer_;
  const Camera& camera_;
  Target target_;
  double diagonal_;
  Image reference_;
};

// Measures candidates: first each ladder once, as far up as it is worth it, then all that are not clearly beaten again
// and again, interleaved, so that a slow moment of the machine does not hit one of them alone.
class Search {
 public:
  Search(Measurement& measurement, double maxError, Progress& progress)
      : measurement_(measurement), maxError_(maxError), progress_(progress) {}

  void climb(const std::vector<Ladder>& ladders) {
    std::size_t number = 0, total = 0;
    for (const Ladder& ladder : ladders) total += ladder.size();
    for (const Ladder& ladder : ladders) {
      ladderStart_ = points_.size();
      std::size_t left = ladder.size();
      for (const Candidate& candidate : ladder) {
        progress_.show("candidate " + std::to_string(++number) + " of at most " + std::to_string(total) + ": " +
                       candidate.text());
        --left;
        if (!tryOne(candidate)) break;
      }
      total -= left;
    }
  }

  void repeat(int rounds) {
    std::vector<std::size_t> contenders;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (!clearlyBeaten(points_[i].cost, costs_)) contenders.push_back(i);
    for (int round = 0; round < rounds; ++round)
      for (const std::size_t i : contenders) {
        progress_.show("repeat " + std::to_string(round + 1) + " of " + std::to_string(rounds) + ": " +
                       points_[i].candidate.text());
        times_[i].add(measurement_.draw(points_[i].candidate.settings).times);
        ++points_[i].runs;
      }
    for (const std::size_t i : contenders)
      costs_[i].milliseconds = points_[i].cost.milliseconds = structureMilliseconds(times_[i]);
  }

  // Index of the chosen point. Throws Error (failed) if no point is accurate enough.
  std::size_t choose() const {
    if (const std::optional<std::size_t> best = fastestWithin(costs_, maxError_)) return *best;
    if (points_.empty()) throw Error(ErrorKind::failed, "nothing could be measured: " + skipped_.front());
    const auto least =
        std::min_element(costs_.begin(), costs_.end(), [](const Cost& a, const Cost& b) { return a.error < b.error; });
    const TunePoint& closest = points_[static_cast<std::size_t>(least - costs_.begin())];
    char errors[128];
    std::snprintf(errors, sizeof(errors),
                  "no settings reach --max-error %g: the lowest hit_error measured is %g, with ", maxError_,
                  closest.cost.error);
    throw Error(ErrorKind::failed, std::string(errors) + closest.candidate.text());
  }

  const std::vector<TunePoint>& points() const { return points_; }
  const std::vector<std::string>& skipped() const { return skipped_; }

 private:
  // Returns whether a larger one is worth a try.
  bool tryOne(const Candidate& candidate) {
    try {
      const FrameReport report = measurement_.draw(candidate.settings);
      StageTimes times;
      times.add(report.times);
      const Cost cost{structureMilliseconds(times), report.memory.structureTotal, measurement_.error()};
      if (repeatsLast(cost)) return true;
      std::optional<std::size_t> best = fastestWithin(costs_, maxError_);
      if (!best) best = fastestWithin(costs_, 1);
      const bool tooSlow = best && cost.milliseconds > kTooSlow * costs_[*best].milliseconds;
      // Another point is accurate enough in half the time and no more memory, so no larger one would be chosen.
      const bool beaten = clearlyBeaten({cost.milliseconds, cost.bytes, maxError_}, costs_);
      points_.push_back({candidate, cost, 1});
      costs_.push_back(cost);
      times_.push_back(std::move(times));
      return !tooSlow && !beaten;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::failed) throw;
      skipped_.push_back(candidate.text() + ": " + error.what());
      return false;
    }
  }

  // Beyond a setting's effective limit, larger values make the same structure.
  bool repeatsLast(const Cost& cost) const {
    return costs_.size() > ladderStart_ && costs_.back().bytes == cost.bytes && costs_.back().error == cost.error;
  }

  Measurement& measurement_;
  double maxError_;
  Progress& progress_;
  std::vector<TunePoint> points_;
  std::vector<Cost> costs_;  // those of the points
  std::vector<StageTimes> times_;
  std::size_t ladderStart_ = 0;
  std::vector<std::string> skipped_;
};

// What was asked for, as it would be typed, without the settings.
std::string viewText(const ViewRequest& request) {
  std::string text = request.scene;
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) text += std::string(" ") + option + ' ' + value;
  };
  const auto addNumber = [&](const char* option, const std::optional<double>& value) {
    if (value) add(option, nlohmann::json(*value).dump());
  };
  add("--camera", request.camera);
  add("--eye", request.eye);
  add("--target", request.target);
  addNumber("--fov", request.fov);
  addNumber("--time", request.time);
  for (const std::string& mirror : request.mirrors) add("--mirror", mirror);
  add("--sky", request.sky);
  return text;
}

void tune(const TuneRequest& request) {
  // First everything that can be wrong with the request itself, before any long work.
  if (!(request.maxError >= 0 && request.maxError <= 1))
    throw Error(ErrorKind::usage, "--max-error must be from 0 to 1: the fraction of rays that may be wrong");
  const ViewArguments arguments = checkView(request.view);
  const std::vector<Ladder> ladders = tuneLadders(request.view);
  AtomicFile output(request.output);

  Progress progress;
  progress.show("loading " + request.view.scene);
  const PosedView view = loadView(request.view, arguments);
  const Camera camera = chooseCamera(view, arguments.camera);
  keepFreedMemory();
  std::vector<std::string> warnings;
  const Context context = openContext(request.view.context, request.view.device, warnings);
  for (const std::string& warning : warnings) std::cerr << "warning: " << warning << '\n';
  const gl::Api api = gl::Api::load(context.getProcAddress());
  const OffscreenTarget target(api, arguments.size);
  Renderer renderer(context.getProcAddress(), exactFactory(view.model.scene, request.view.threads));
  show(view, renderer);

  progress.show("reference");
  Measurement measurement(renderer, camera, target.target(), view.bounds.diagonal());
  const FrameReport truth = measurement.drawReference(ladders.front().front().settings);
  if (truth.selected == 0)
    throw Error(ErrorKind::badInput,
                request.view.scene + ": no pixel of this view is traced, so there is nothing to tune");
  Search search(measurement, request.maxError, progress);
  search.climb(ladders);
  search.repeat(request.repeat - 1);

  TuneReport report;
  report.view = viewText(request.view);
  report.device = renderer.device();
  report.context = context.name();
  report.width = arguments.size.width;
  report.height = arguments.size.height;
  report.triangles = view.model.scene.triangles.size();
  report.coverage = static_cast<double>(truth.selected) / static_cast<double>(truth.pixels);
  report.maxError = request.maxError;
  report.choice = search.choose();
  report.points = search.points();
  report.skipped = search.skipped();
  output.write(tuneConfig(report));

  progress.clear();
  for (const std::string& warning : view.model.warnings) std::cerr << "warning: " << warning << '\n';
  // The table comes first: if it cannot be written the run fails, and a failed run leaves no files.
  if (!(std::cout << tuneTable(report) << std::flush)) throw Error(ErrorKind::failed, "cannot write the table");
  output.commit();
}

}  // namespace

void addTuneCommand(CLI::App& program) {
  CLI::App* command = program.add_subcommand("tune", "Find the fastest settings that are accurate enough for a view");
  const auto shared = std::make_shared<TuneRequest>();
  TuneRequest& request = *shared;
  command
      ->add_option("--max-error", request.maxError,
                   "Largest accepted hit_error, 0 to 1: the fraction of rays whose hit may differ from the exact one")
      ->capture_default_str();
  command
      ->add_option("-o,--output", request.output,
                   "File for `render --config`: the chosen settings, with the measurements as comments")
      ->capture_default_str();
  command->add_option("--repeat", request.repeat, "Frames to measure per candidate; times are medians")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  addViewOptions(*command, request.view);
  command->footer(
      "Tries the methods " + tunedSettings() +
      ".\nSettings given by --set are not varied: --set trace.method=attributes tunes that method alone. --preset "
      "and\n--config decide what is drawn; the settings of voxels, abuffer and search start from each method's own "
      "preset.");
  command->callback([shared] { tune(*shared); });
}

}  // namespace halfsilver
