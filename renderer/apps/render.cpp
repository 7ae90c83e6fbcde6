#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <halfsilver/budget.h>
#include <halfsilver/error.h>
#include <halfsilver/renderer.h>
#include "apps/commands.h"
#include "apps/drawing.h"
#include "apps/exposure.h"
#include "apps/outputs.h"
#include "apps/render_job.h"
#include "apps/sequence.h"

namespace halfsilver {
namespace {

struct RenderRequest {
  ViewRequest view;
  OutputPaths outputs;
  std::optional<int> repeat;
  int samples = 1;
  std::optional<int> passes, progressEvery;
  std::string frames;
  std::optional<double> framesPerSecond;
  bool overwrite = false;
  std::string exposure;
  std::optional<double> budgetMilliseconds, budgetMegabytes;
};

// Frames that a budget may take to settle.
constexpr int kMaxBudgetFrames = 60;

// Of an effect that sends several per pixel; whitted sends one per pass.
EffectSettings raysOf(const Settings& settings) {
  EffectSettings rays = settings.effect;
  if (settings.trace.effect == Effect::whitted) rays.samples = 1;
  return rays;
}

// The frames of a run: the first one, repeated until its structure has found its size; with a budget, more until it is
// at rest; then the measured ones, if any. If none are asked for, the last frame so far is the picture and its times
// are reported as those of a first frame.
class Frames {
 public:
  Frames(Renderer& renderer, const Camera& camera, const Target& target, const RenderRequest& request,
         RunStatistics& statistics)
      : renderer_(&renderer), camera_(&camera), target_(target), samples_(request.samples), statistics_(&statistics) {
    if (!request.budgetMilliseconds && !request.budgetMegabytes) return;
    BudgetLimits limits;
    if (request.budgetMilliseconds) limits.milliseconds = *request.budgetMilliseconds;
    if (request.budgetMegabytes) limits.bytes = 1e6 * *request.budgetMegabytes;
    limits.minContribution = statistics.settings.select.minContribution;
    statistics.budget = {.limits = limits};
    if (statistics.settings.trace.effect == Effect::reflection)
      budget_.emplace(limits);
    else
      passBudget_.emplace(limits.milliseconds, raysOf(statistics.settings));
  }

  void draw(int repeat, const PassSteps& steps, Progress& progress, WallClock& clock) {
    FrameReport& report = statistics_->report;
    progress.show("first frame");
    int warmUp = drawFirstFrame(*renderer_, *camera_, statistics_->settings, target_, report, samples_, steps);
    std::vector<StageTime> pictureTimes = report.times;
    statistics_->device = renderer_->device();  // with the programs that it has made
    addWarnings(report.warnings, statistics_->warnings);
    clock.lap("first_frame");
    const std::vector<StageTime> firstTimes = pictureTimes;
    if (hasBudget()) {
      for (int i = 0; i < kMaxBudgetFrames && !atRest(); ++i, ++warmUp) {
        progress.show("budget, frame " + std::to_string(i + 1));
        drawNext();
      }
      pictureTimes = report.times;
      statistics_->budget->settled = atRest();
      statistics_->budget->frames = repeat == 0 ? 1 : 0;
      statistics_->budget->held = repeat == 0 && held() ? 1 : 0;
      clock.lap("budget");
    }
    statistics_->firstFrame = repeat == 0 && !hasBudget();
    statistics_->warmUpFrames = warmUp - (repeat == 0 ? 1 : 0);
    StageTimes times;
    for (int frame = 0; frame < repeat; ++frame) {
      progress.show("frame " + std::to_string(frame + 1) + " of " + std::to_string(repeat));
      drawNext();
      times.add(report.times);
      if (!hasBudget()) continue;
      ++statistics_->budget->frames;
      statistics_->budget->held += held();
    }
    if (repeat == 0) times.add(pictureTimes);
    // Stages that only the first frame ran (shadow maps, structures that are kept) are reported with its time.
    for (const StageTime& time : firstTimes)
      if (!times.has(time.stage)) times.add(std::span(&time, 1));
    statistics_->stages = times.summarize();
    if (repeat > 0) clock.lap("frames");
    warnOfLosses();
  }

 private:
  bool hasBudget() const { return budget_ || passBudget_; }
  bool atRest() const { return budget_ ? budget_->atRest() : passBudget_->atRest(); }
  bool held() const { return budget_ ? budget_->held() : passBudget_->held(); }

  void drawNext() {
    Settings settings = statistics_->settings;
    if (budget_) {
      settings.select.minContribution = budget_->minContribution();
      if (budget_->forgetStructures()) renderer_->forgetStructures();
      statistics_->budget->minContribution = settings.select.minContribution;
    }
    if (passBudget_) {
      settings.effect.passes = passBudget_->passes();
      settings.effect.samples = passBudget_->samples();
      statistics_->budget->raysPerPixel = {passBudget_->raysPerPixel(), passBudget_->wanted()};
    }
    statistics_->report = drawPicture(*renderer_, *camera_, settings, target_, samples_);
    if (budget_) {
      budget_->learn(statistics_->report);
      statistics_->budget->dropped = budget_->dropped();
    }
    if (passBudget_) passBudget_->learn(statistics_->report);
    addWarnings(statistics_->report.warnings, statistics_->warnings);
  }

  void warnOfLosses() {
    if (statistics_->budget && statistics_->budget->held < statistics_->budget->frames)
      addWarnings({"not every frame stayed within the budget"}, statistics_->warnings);
    halfsilver::warnOfLosses(statistics_->report, statistics_->warnings);
  }

  Renderer* renderer_;
  const Camera* camera_;
  Target target_;
  int samples_;
  RunStatistics* statistics_;
  std::optional<Budget> budget_;
  std::optional<PassBudget> passBudget_;  // of effects that send several rays per pixel
};

void checkBudget(const char* option, const std::optional<double>& limit) {
  if (limit && !(*limit > 0 && std::isfinite(*limit)))
    throw Error(ErrorKind::usage, std::string(option) + " must be a number greater than 0");
}

// What the effect has to do with the request.
void checkPasses(const RenderRequest& request, const Settings& settings) {
  const bool reflects = settings.trace.effect == Effect::reflection;
  if (reflects && (request.passes || request.progressEvery))
    throw Error(ErrorKind::usage,
                "--passes and --progress-every need an effect of several passes (trace.effect); --samples refines "
                "reflections");
  if (!reflects && request.budgetMegabytes)
    throw Error(ErrorKind::usage, "--budget-mb needs trace.effect=reflection, whose least visible rays can go");
  if (settings.trace.effect == Effect::layers && request.budgetMilliseconds)
    throw Error(ErrorKind::usage, "--budget-ms needs an effect that can send fewer rays, which layers cannot");
  if (!reflects && request.budgetMilliseconds && settings.effect.progressive)
    throw Error(ErrorKind::usage, "--budget-ms cannot be combined with effect.progressive");
  if (request.progressEvery && settings.image.antialiasing == Antialiasing::temporal)
    throw Error(ErrorKind::usage, "--progress-every cannot be combined with image.antialiasing=temporal");
}

// Shows how many passes of a picture are done, and writes what there is if it is asked for.
PassSteps passSteps(const RenderRequest& request, RenderJob& job, Progress& progress) {
  constexpr int kSteps = 50;  // of progress that is only told
  const Settings& settings = job.statistics.settings;
  if (settings.trace.effect == Effect::reflection || settings.image.antialiasing == Antialiasing::temporal) return {};
  const int all = settings.effect.passes;
  const bool writes = request.progressEvery.has_value();
  return {.every = request.progressEvery.value_or((all + kSteps - 1) / kSteps),
          .shown = [&request, &job, &progress, all, writes](int done) {
            progress.show("pass " + std::to_string(done) + " of " + std::to_string(all));
            if (!writes) return;
            Outputs outputs({.picture = request.outputs.picture, .stats = {}, .layers = {}});
            outputs.writePictures(job.renderer, job.target, job.statistics.diagonal);
            outputs.commit();
          }};
}

// First everything that can be wrong with the request itself, before any long work.
std::optional<FrameRange> checkRequest(const RenderRequest& request) {
  checkBudget("--budget-ms", request.budgetMilliseconds);
  checkBudget("--budget-mb", request.budgetMegabytes);
  if (request.samples > 1 && (request.budgetMilliseconds || request.budgetMegabytes))
    throw Error(ErrorKind::usage, "--samples cannot be combined with a budget");
  checkOutputs(request.outputs);
  if (request.progressEvery &&
      (request.samples > 1 || request.repeat || !request.frames.empty() || request.budgetMilliseconds))
    throw Error(ErrorKind::usage,
                "--progress-every cannot be combined with --samples, --repeat, --frames or --budget-ms");
  if (request.frames.empty()) {
    if (request.framesPerSecond || request.overwrite)
      throw Error(ErrorKind::usage, std::string(request.overwrite ? "--overwrite" : "--fps") + " needs --frames");
    return std::nullopt;
  }
  if (request.view.time || request.repeat || request.budgetMilliseconds || request.budgetMegabytes)
    throw Error(ErrorKind::usage, "--frames cannot be combined with --time, --repeat or a budget");
  return parseFrames(request.frames, request.framesPerSecond.value_or(kFramesPerSecond));
}

void renderPicture(const RenderRequest& request, const ViewArguments& arguments, const Settings& settings,
                   Progress& progress, WallClock& clock) {
  Outputs outputs(request.outputs);
  progress.show("loading " + request.view.scene);
  PosedView view = loadView(request.view, arguments);
  keepOriginNear(view, arguments.camera);
  const Camera camera = chooseCamera(view, arguments.camera);
  clock.lap("load");
  RenderJob job(request.view, arguments, settings, std::move(view), progress, clock);
  RunStatistics& statistics = job.statistics;
  progress.show("calibration");
  decideMethod(job, camera, statistics.settings);
  clock.lap("calibration");
  if (request.exposure == "auto") {
    progress.show("exposure");
    exposeFor(job, camera, statistics.settings);
    clock.lap("exposure");
  }

  const bool once = request.samples > 1 || (settings.effect.passes > 1 && settings.trace.effect != Effect::reflection);
  const int repeat = request.repeat.value_or(request.outputs.stats.empty() || once ? 0 : 1);
  statistics.samples = request.samples;
  Frames(job.renderer, camera, job.target.target(), request, statistics)
      .draw(repeat, passSteps(request, job, progress), progress, clock);
  checkErrors(job.api);
  progress.show("writing " + request.outputs.picture);
  const double white = outputs.writePictures(job.renderer, job.target, statistics.diagonal);
  if (const std::string hint = whiteHint(white); !hint.empty()) addWarnings({hint}, statistics.warnings);
  clock.lap("write");
  statistics.wallMilliseconds = clock.milliseconds();
  outputs.writeStatistics(statistics);

  progress.clear();
  for (const std::string& warning : statistics.warnings) std::cerr << "warning: " << warning << '\n';
  // The table comes first: if it cannot be written the run fails, and a failed run leaves no files.
  if (!(std::cout << toTable(statistics) << std::flush)) throw Error(ErrorKind::failed, "cannot write the table");
  outputs.commit();
}

void render(const RenderRequest& request) {
  WallClock clock;
  const std::optional<FrameRange> range = checkRequest(request);
  const ViewArguments arguments = checkView(request.view);
  // What rays ask for is what a budget of memory can lower: other structures than that of identity hold all.
  Settings settings = request.budgetMegabytes ? baseSettings(request.view) : programSettings(request.view);
  applyOverrides(settings, request.view);
  if (!request.exposure.empty())
    settings.image.exposure = parseExposure(request.exposure).value_or(settings.image.exposure);
  if (request.passes) set(settings, "effect.passes", std::to_string(*request.passes));
  checkPasses(request, settings);
  if (range && settings.image.antialiasing == Antialiasing::temporal)
    throw Error(
        ErrorKind::usage,
        "--frames cannot be combined with image.antialiasing=temporal, which makes a frame depend on those before "
        "it: use --samples");
  Progress progress;
  if (range)
    renderSequence({request.view, arguments, settings, request.outputs, *range, request.overwrite, request.samples,
                    request.exposure == "auto"},
                   progress, clock);
  else
    renderPicture(request, arguments, settings, progress, clock);
}

void addOutputOptions(CLI::App& command, RenderRequest& request) {
  command
      .add_option("-o,--output", request.outputs.picture,
                  "Picture: .png (tone-mapped sRGB) or .exr (linear); #### is the frame's number, with --frames")
      ->required();
  command.add_option("--stats", request.outputs.stats, "Write statistics as JSON to this file");
  command.add_option("--layers", request.outputs.layers,
                     "Write all layers to one .exr file: depth, normal, selected, hit, reflection, ...");
}

}  // namespace

void addRenderCommand(CLI::App& program) {
  CLI::App* command = program.add_subcommand("render", "Render one picture of a scene");
  const auto shared = std::make_shared<RenderRequest>();
  RenderRequest& request = *shared;
  addOutputOptions(*command, request);
  addViewOptions(*command, request.view);
  command
      ->add_option("--repeat", request.repeat,
                   "Frames to measure after the first one; times are medians (default: 1 with --stats but without "
                   "--samples and --passes, otherwise none, and the picture is the first frame)")
      ->check(CLI::Range(1, 100000));
  command
      ->add_option("--samples", request.samples,
                   "Samples per pixel, 1 to 4096: the picture is the mean of as many frames, in linear light, each "
                   "with its own rays; times are those of the whole picture")
      ->check(CLI::Range(1, kMaxSamples))
      ->capture_default_str();
  command
      ->add_option("--passes", request.passes,
                   "Passes of an effect that sends several rays per pixel (effect.passes): the picture is their mean")
      ->check(CLI::Range(1, 65536));
  command
      ->add_option("--progress-every", request.progressEvery,
                   "Write the picture as it is after every so many passes, too")
      ->check(CLI::Range(1, 65536));
  command->add_option(
      "--exposure", request.exposure,
      "Stops by which the picture is brightened (image.exposure), or auto: what suits the picture, of a "
      "sequence its first frame");
  command->add_option(
      "--frames", request.frames,
      "A..B: render an image sequence of the animations, frame n at n / fps seconds; frames whose files "
      "exist are left as they are");
  command->add_option("--fps", request.framesPerSecond, "Frames per second of the sequence (default: 24)");
  command->add_flag("--overwrite", request.overwrite, "Also render frames whose files exist");
  command->add_option(
      "--budget-ms", request.budgetMilliseconds,
      "Time limit per frame in milliseconds; drops the least visible reflections until it is met, or sends fewer "
      "rays per pixel of effects that send several");
  command->add_option("--budget-mb", request.budgetMegabytes,
                      "Memory limit of the acceleration structure in megabytes, met in the same way");
  command->callback([shared] { render(*shared); });
}

}  // namespace halfsilver
