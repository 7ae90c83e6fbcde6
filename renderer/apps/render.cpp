#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <halfsilver/budget.h>
#include <halfsilver/context.h>
#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include <halfsilver/renderer.h>
#include "apps/arguments.h"
#include "apps/commands.h"
#include "apps/drawing.h"
#include "apps/offscreen.h"
#include "apps/progress.h"
#include "apps/statistics.h"
#include "apps/view_request.h"
#include "apps/wall_clock.h"
#include "io/atomic_file.h"

namespace halfsilver {
namespace {

struct RenderRequest {
  ViewRequest view;
  std::string output, stats, layers;
  std::optional<int> repeat;
  std::optional<double> budgetMilliseconds, budgetMegabytes;
};

std::string lowerExtension(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : static_cast<char>(c);
  });
  return extension;
}

// The output files of a run: either all appear or none.
class Outputs {
 public:
  explicit Outputs(const RenderRequest& request) {
    const std::string extension = lowerExtension(request.output);
    if (extension != ".png" && extension != ".exr")
      throw Error(ErrorKind::usage, "-o " + request.output + ": the picture must be a .png or .exr file");
    if (!request.layers.empty() && lowerExtension(request.layers) != ".exr")
      throw Error(ErrorKind::usage, "--layers " + request.layers + ": layers must be an .exr file");
    linear_ = extension == ".exr";
    add(picture_, request.output);
    add(stats_, request.stats);
    add(layers_, request.layers);
  }

  bool linear() const { return linear_; }
  bool wantsLayers() const { return linear_ || layers_.has_value(); }

  void writePicture(std::span<const std::byte> bytes) { picture_->write(bytes); }
  void writeStatistics(const RunStatistics& statistics) {
    if (stats_) stats_->write(dump(toJson(statistics)));
  }
  void writeLayers(const Image& layers, double diagonal) {
    if (layers_) layers_->write(encodeExr(layers, diagonal));
  }
  // Every file is complete by now: all that is left is to rename them.
  void commit() {
    for (std::optional<AtomicFile>* file : {&layers_, &stats_, &picture_})
      if (*file) (*file)->commit();
  }

 private:
  void add(std::optional<AtomicFile>& file, const std::string& path) {
    if (path.empty()) return;
    const std::filesystem::path absolute = std::filesystem::weakly_canonical(std::filesystem::absolute(path));
    if (std::find(paths_.begin(), paths_.end(), absolute) != paths_.end())
      throw Error(ErrorKind::usage, path + " is given for two outputs");
    paths_.push_back(absolute);
    file.emplace(path);
  }

  std::optional<AtomicFile> picture_, stats_, layers_;
  std::vector<std::filesystem::path> paths_;
  bool linear_ = false;
};

void addWarnings(const std::vector<std::string>& from, std::vector<std::string>& to) {
  for (const std::string& warning : from)
    if (std::find(to.begin(), to.end(), warning) == to.end()) to.push_back(warning);
}

// Frames that a budget may take to settle.
constexpr int kMaxBudgetFrames = 60;

// The frames of a run: the first one, repeated until its structure has found its size; with a budget, more until it is
// at rest; then the measured ones, if any. If none are asked for, the last frame so far is the picture and its times
// are reported as those of a first frame.
class Frames {
 public:
  Frames(Renderer& renderer, const Camera& camera, const Target& target, const RenderRequest& request,
         RunStatistics& statistics)
      : renderer_(&renderer), camera_(&camera), target_(target), statistics_(&statistics) {
    if (!request.budgetMilliseconds && !request.budgetMegabytes) return;
    BudgetLimits limits;
    if (request.budgetMilliseconds) limits.milliseconds = *request.budgetMilliseconds;
    if (request.budgetMegabytes) limits.bytes = 1e6 * *request.budgetMegabytes;
    limits.minContribution = statistics.settings.select.minContribution;
    budget_.emplace(limits);
    statistics.budget = {.limits = limits};
  }

  void draw(int repeat, Progress& progress, WallClock& clock) {
    FrameReport& report = statistics_->report;
    progress.show("first frame");
    int warmUp = drawFirstFrame(*renderer_, *camera_, statistics_->settings, target_, report);
    std::vector<StageTime> pictureTimes = report.times;
    addWarnings(report.warnings, statistics_->warnings);
    clock.lap("first_frame");
    const std::vector<StageTime> firstTimes = pictureTimes;
    if (budget_) {
      for (int i = 0; i < kMaxBudgetFrames && !budget_->atRest(); ++i, ++warmUp) {
        progress.show("budget, frame " + std::to_string(i + 1));
        drawNext();
      }
      pictureTimes = report.times;
      statistics_->budget->settled = budget_->atRest();
      statistics_->budget->frames = repeat == 0 ? 1 : 0;
      statistics_->budget->held = repeat == 0 && budget_->held() ? 1 : 0;
      clock.lap("budget");
    }
    statistics_->firstFrame = repeat == 0 && !budget_;
    statistics_->warmUpFrames = warmUp - (repeat == 0 ? 1 : 0);
    StageTimes times;
    for (int frame = 0; frame < repeat; ++frame) {
      progress.show("frame " + std::to_string(frame + 1) + " of " + std::to_string(repeat));
      drawNext();
      times.add(report.times);
      if (!budget_) continue;
      ++statistics_->budget->frames;
      statistics_->budget->held += budget_->held();
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
  void drawNext() {
    Settings settings = statistics_->settings;
    if (budget_) {
      settings.select.minContribution = budget_->minContribution();
      if (budget_->forgetStructures()) renderer_->forgetStructures();
      statistics_->budget->minContribution = settings.select.minContribution;
    }
    renderer_->render(*camera_, settings, target_);
    statistics_->report = renderer_->report();
    if (budget_) {
      budget_->learn(statistics_->report);
      statistics_->budget->dropped = budget_->dropped();
    }
    addWarnings(statistics_->report.warnings, statistics_->warnings);
  }

  void warnOfLosses() {
    const FrameReport& report = statistics_->report;
    if (statistics_->budget && statistics_->budget->held < statistics_->budget->frames)
      addWarnings({"not every frame stayed within the budget"}, statistics_->warnings);
    if (report.overflow > 0)
      addWarnings({std::to_string(report.overflow) + " rays were given up (hit.T -3)"}, statistics_->warnings);
    if (report.lostFragments > 0)
      addWarnings({std::to_string(report.lostFragments) + " fragments did not fit into the A-buffer"},
                  statistics_->warnings);
  }

  Renderer* renderer_;
  const Camera* camera_;
  Target target_;
  RunStatistics* statistics_;
  std::optional<Budget> budget_;
};

// Writes the last frame under temporary names.
void writePictures(const Renderer& renderer, const OffscreenTarget& target, const Size& size, double diagonal,
                   Outputs& outputs) {
  const Image layers = outputs.wantsLayers() ? renderer.readLayers() : Image{};
  if (outputs.linear()) {
    Image picture{layers.width, layers.height, {"R", "G", "B", "A"}, {}};
    picture.data.reserve(layers.pixelCount() * 4);
    for (std::size_t pixel = 0; pixel < layers.pixelCount(); ++pixel)
      for (const std::string& name : picture.channels)
        picture.data.push_back(
            layers.data[pixel * layers.channels.size() + static_cast<std::size_t>(layers.channel(name))]);
    outputs.writePicture(encodeExr(picture, diagonal));
  } else {
    outputs.writePicture(encodePng(size.width, size.height, target.read()));
  }
  outputs.writeLayers(layers, diagonal);
}

void checkBudget(const char* option, const std::optional<double>& limit) {
  if (limit && !(*limit > 0 && std::isfinite(*limit)))
    throw Error(ErrorKind::usage, std::string(option) + " must be a number greater than 0");
}

void render(const RenderRequest& request) {
  WallClock clock;
  // First everything that can be wrong with the request itself, before any long work.
  checkBudget("--budget-ms", request.budgetMilliseconds);
  checkBudget("--budget-mb", request.budgetMegabytes);
  const ViewArguments arguments = checkView(request.view);
  const Size& size = arguments.size;
  RunStatistics statistics;
  statistics.settings = baseSettings(request.view);
  applyOverrides(statistics.settings, request.view);
  Outputs outputs(request);

  Progress progress;
  progress.show("loading " + request.view.scene);
  const Model model = loadModel(request.view, arguments);
  const Camera camera = chooseCamera(model.scene, arguments.camera);
  statistics.sceneFile = request.view.scene;
  statistics.triangles = model.scene.triangles.size();
  statistics.vertices = model.scene.vertices.size();
  statistics.materials = model.scene.materials.size();
  statistics.textures = model.scene.textures.size();
  statistics.lights = model.scene.lights.size();
  statistics.diagonal = model.scene.bounds().diagonal();
  statistics.width = size.width;
  statistics.height = size.height;
  statistics.warnings = model.warnings;
  clock.lap("load");

  const Context context = makeContext(contextKind(request.view.context));
  const gl::Api api = gl::Api::load(context.getProcAddress());
  const OffscreenTarget target(api, size);
  Renderer renderer(context.getProcAddress(), exactFactory(model.scene, request.view.threads));
  statistics.device = renderer.device();
  statistics.context = context.name();
  clock.lap("context");
  progress.show("uploading " + std::to_string(statistics.triangles) + " triangles");
  renderer.setScene(model.scene);
  clock.lap("upload");

  const int repeat = request.repeat.value_or(request.stats.empty() ? 0 : 1);
  Frames(renderer, camera, target.target(), request, statistics).draw(repeat, progress, clock);
  progress.show("writing " + request.output);
  writePictures(renderer, target, size, statistics.diagonal, outputs);
  clock.lap("write");
  statistics.wallMilliseconds = clock.milliseconds();
  outputs.writeStatistics(statistics);

  progress.clear();
  for (const std::string& warning : statistics.warnings) std::cerr << "warning: " << warning << '\n';
  // The table comes first: if it cannot be written the run fails, and a failed run leaves no files.
  if (!(std::cout << toTable(statistics) << std::flush)) throw Error(ErrorKind::failed, "cannot write the table");
  outputs.commit();
}

void addOutputOptions(CLI::App& command, RenderRequest& request) {
  command.add_option("-o,--output", request.output, "Picture: .png (tone-mapped sRGB) or .exr (linear)")->required();
  command.add_option("--stats", request.stats, "Write statistics as JSON to this file");
  command.add_option("--layers", request.layers,
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
                   "Frames to measure after the first one; times are medians (default: 1 with --stats, otherwise "
                   "none, and the picture is the first frame)")
      ->check(CLI::Range(1, 100000));
  command->add_option("--budget-ms", request.budgetMilliseconds,
                      "Time limit per frame in milliseconds; drops the least visible reflections until it is met");
  command->add_option("--budget-mb", request.budgetMegabytes,
                      "Memory limit of the acceleration structure in megabytes, met in the same way");
  command->callback([shared] { render(*shared); });
}

}  // namespace halfsilver
