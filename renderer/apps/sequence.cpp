#include "apps/sequence.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <utility>
#include <vector>

#include <halfsilver/error.h>
#include <halfsilver/pose.h>
#include "apps/drawing.h"
#include "apps/exposure.h"
#include "apps/render_job.h"

namespace halfsilver {
namespace {

constexpr int kLastFrame = 9999999;

std::optional<int> parseNumber(std::string_view text) {
  int value = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size() || value < 0) return std::nullopt;
  return value;
}

OutputPaths numbered(const OutputPaths& paths, int frame) {
  const auto one = [frame](const std::string& path) { return path.empty() ? path : halfsilver::numbered(path, frame); };
  return {one(paths.picture), one(paths.stats), one(paths.layers)};
}

bool complete(const OutputPaths& paths) {
  const std::vector<std::string> wanted = paths.wanted();
  return std::all_of(wanted.begin(), wanted.end(), [](const std::string& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
  });
}

std::string minutes(double seconds) {
  const auto whole = static_cast<long>(std::lround(seconds));
  const std::string rest = std::to_string(whole % 60);
  return std::to_string(whole / 60) + (rest.size() < 2 ? ":0" : ":") + rest;
}

// How far a run has come and how long the rest will take, from the mean of the frames so far.
class Pace {
 public:
  explicit Pace(std::size_t frames) : frames_(frames) {}

  std::string next(int frame) {
    std::string text =
        "frame " + std::to_string(frame) + " (" + std::to_string(drawn_ + 1) + " of " + std::to_string(frames_) + ")";
    if (drawn_ > 0)
      text += ", " + minutes(seconds() / static_cast<double>(drawn_) * static_cast<double>(frames_ - drawn_)) + " left";
    ++drawn_;
    return text;
  }
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::size_t frames_, drawn_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

FrameRange parseFrames(std::string_view text, double framesPerSecond) {
  const std::size_t dots = text.find("..");
  const std::optional<int> first = parseNumber(text.substr(0, dots));
  const std::optional<int> last = dots == std::string_view::npos ? first : parseNumber(text.substr(dots + 2));
  if (!first || !last || *first > *last || *last > kLastFrame)
    throw Error(ErrorKind::usage,
                "--frames " + std::string(text) +
                    ": expected A..B, whole numbers with 0 <= A <= B <= " + std::to_string(kLastFrame));
  if (!(framesPerSecond > 0 && std::isfinite(framesPerSecond)))
    throw Error(ErrorKind::usage, "--fps must be a number greater than 0");
  return {*first, *last, framesPerSecond};
}

std::string numbered(const std::string& path, int frame) {
  const std::size_t end = path.find_last_of('#');
  if (end == std::string::npos)
    throw Error(ErrorKind::usage, path + ": with --frames a file's name needs #### for the frame's number");
  const std::size_t before = path.find_last_not_of('#', end);
  const std::size_t first = before == std::string::npos ? 0 : before + 1;
  std::string number = std::to_string(frame);
  if (const std::size_t width = end + 1 - first; number.size() < width) number.insert(0, width - number.size(), '0');
  return path.substr(0, first) + number + path.substr(end + 1);
}

void renderSequence(const SequenceRequest& request, Progress& progress, WallClock& clock) {
  std::vector<int> frames;
  for (int frame = request.range.first; frame <= request.range.last; ++frame)
    if (const OutputPaths paths = numbered(request.outputs, frame); request.overwrite || !complete(paths))
      frames.push_back(frame);
  const int all = request.range.last - request.range.first + 1;
  if (frames.empty()) {
    std::cout << "all " << all << " frames are there already\n";
    return;
  }

  progress.show("loading " + request.view.scene);
  PosedView loaded{loadModel(request.view, request.arguments), {}, {}};
  const std::vector<int> animations = chooseAnimations(request.view, loaded.model);
  const auto timeOf = [&](int frame) { return frame / request.range.framesPerSecond; };
  poseView(loaded, animations, timeOf(frames.front()), request.view.loop);
  keepOriginNear(loaded, request.arguments.camera);  // an unknown one is found out before the rest
  clock.lap("load");
  Settings settings = request.settings;
  settings.image.motion = settings.image.motion || !request.outputs.layers.empty();
  RenderJob job(request.view, request.arguments, settings, std::move(loaded), progress, clock);

  const auto pose = [&](int frame) {
    poseView(job.view, animations, timeOf(frame), request.view.loop);
    job.renderer.pose(*job.view.state);
  };
  std::optional<int> drawn;
  // Before a frame and all that is drawn for it.
  const auto moveOrigin = [&](int frame) {
    poseView(job.view, animations, timeOf(frame), request.view.loop);
    if (!keepOriginNear(job.view, request.arguments.camera)) return;
    show(job.view, job.renderer);
    drawn.reset();
  };
  // Motion is that since the frame before: if that one was not drawn, it is drawn now and not kept.
  const auto draw = [&](int frame, int samples, FrameReport& report) {
    pose(frame);
    return drawFirstFrame(job.renderer, chooseCamera(job.view, request.arguments.camera), settings, job.target.target(),
                          report, samples);
  };
  progress.show("calibration");
  decideMethod(job, chooseCamera(job.view, request.arguments.camera), settings,
               [&](int step) { pose(frames.front() + 1 + step); });
  job.statistics.settings = settings;
  clock.lap("calibration");
  if (request.automaticExposure) {
    moveOrigin(request.range.first);
    pose(request.range.first);
    exposeFor(job, chooseCamera(job.view, request.arguments.camera), settings);
    job.statistics.settings = settings;
  }
  std::vector<std::string> warnings = job.statistics.warnings;
  Pace pace(frames.size());
  for (const int frame : frames) {
    progress.show(pace.next(frame));
    Outputs outputs(numbered(request.outputs, frame));
    RunStatistics statistics = job.statistics;
    statistics.samples = request.samples;
    moveOrigin(frame);
    const bool moves = settings.image.motion && frame > 0;
    if (moves && drawn != frame - 1) draw(frame - 1, 1, statistics.report);
    if (draw(frame, request.samples, statistics.report) > 1 && moves) {
      // Drawn again it stood still.
      draw(frame - 1, 1, statistics.report);
      draw(frame, request.samples, statistics.report);
    }
    drawn = frame;
    statistics.device = job.renderer.device();
    statistics.firstFrame = frame == frames.front();
    StageTimes times;
    times.add(statistics.report.times);
    statistics.stages = times.summarize();
    addWarnings(statistics.report.warnings, statistics.warnings);
    warnOfLosses(statistics.report, statistics.warnings);
    addWarnings(statistics.warnings, warnings);
    checkErrors(job.api);
    const double white = outputs.writePictures(job.renderer, job.target, statistics.diagonal);
    if (const std::string hint = whiteHint(white); !hint.empty() && frame == frames.front())
      addWarnings({hint}, warnings);
    outputs.writeStatistics(statistics);
    outputs.commit();
  }
  clock.lap("frames");

  progress.clear();
  for (const std::string& warning : warnings) std::cerr << "warning: " << warning << '\n';
  std::cout << frames.size() << " frames of " << all << " drawn, "
            << std::lround(1000 * pace.seconds() / static_cast<double>(frames.size())) << " ms each\n";
}

}  // namespace halfsilver
