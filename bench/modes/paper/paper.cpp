#include "bench/modes/paper/paper.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <halfsilver/error.h>
#include "apps/drawing.h"
#include "bench/modes/paper/published.h"
#include "bench/modes/paper/report.h"

namespace halfsilver::bench {
namespace {

constexpr int kFrames = 3;          // of a row
constexpr double kLongFrame = 1e4;  // milliseconds; one that takes longer is enough
constexpr int kQuickFactor = 8;     // along each side of a picture

// What a plan works with while it is measured.
struct Subject {
  PaperScenes scenes;
  std::vector<Paper> papers;
};

Size sizeOf(const Paper& paper, const Request& request) {
  if (request.sizeGiven) return request.size;
  if (!request.quick) return paper.size;
  return {paper.size.width / kQuickFactor, paper.size.height / kQuickFactor};
}

double frameOf(const RunStatistics& run) { return timedFrame(run).times.frame.median; }

// Nothing if the layers do not say which shadows are in doubt.
std::optional<ShadowDoubts> doubtsOf(const Image& layers, const Image& truth) {
  if (std::find(layers.channels.begin(), layers.channels.end(), "shadow.marked") == layers.channels.end()) return {};
  const auto at = [](const Image& image, std::size_t pixel, const char* channel) {
    return image.data[pixel * image.channels.size() + static_cast<std::size_t>(image.channel(channel))];
  };
  ShadowDoubts doubts;
  for (std::size_t pixel = 0; pixel < layers.pixelCount(); ++pixel) {
    if (at(truth, pixel, "depth.Z") <= 0) continue;
    ++doubts.pixels;
    bool wrong = false;
    for (const char* channel : {"R", "G", "B"}) {
      const float found = at(layers, pixel, channel), expected = at(truth, pixel, channel);
      wrong = wrong || std::abs(found - expected) > 1e-3f * std::max({std::abs(found), std::abs(expected), 1e-6f});
    }
    const bool marked = at(layers, pixel, "shadow.marked") > 0;
    doubts.marked += marked;
    (marked ? doubts.wrongMarked : doubts.wrongUnmarked) += wrong;
  }
  return doubts;
}

PaperResult measure(Workbench& bench, const OutputFolder& folder, const BenchScene& scene, const PublishedRow& row,
                    const Size& size, bool quick, const std::string& picture) {
  RunStatistics run = bench.describe(scene, row.settings);
  run.width = size.width;
  run.height = size.height;
  bench.draw(scene, run);
  StageTimes times;
  for (int frame = 0; frame < (quick ? 1 : kFrames); ++frame) {
    bench.startOver(scene);
    bench.drawNext(scene, run);
    times.add(run.report.times);
    run.stages = times.summarize();
    if (frameOf(run) > kLongFrame) break;
  }
  PaperResult result{timedFrame(run),        {}, {}, run.report.rays[kShadowRays], run.report.resampled,
                     run.report.interpolated};
  if (row.picture) savePicture(folder, picture, bench);
  const std::string& method = row.settings.trace.method;
  const bool isTruth = !row.truth && (method == "none" || method == "exact");
  if (isTruth || !exactFactory(scene.model.scene, 0)) return result;
  const Image layers = bench.layers();
  RunStatistics truth = run;
  if (row.truth) truth.settings = *row.truth;
  truth.settings.trace.method = "exact";
  bench.draw(scene, truth);
  const Image expected = bench.layers();
  result.error = errorOf(layers, expected, scene.diagonal);
  result.shadows = doubtsOf(layers, expected);
  return result;
}

Plan planPaper(const Setup& setup) {
  const Request& request = setup.request;
  const auto subject = std::make_shared<Subject>();
  subject->scenes = paperScenes(request.sceneFolder, request.quick);
  std::vector<std::string> names;
  for (Paper& paper : publishedPapers(subject->scenes, request.quick)) {
    names.push_back(paper.name);
    if (request.paper == "all" || request.paper == paper.name) subject->papers.push_back(std::move(paper));
  }
  if (subject->papers.empty()) {
    std::string known;
    for (const std::string& name : names) known += name + ", ";
    throw Error(ErrorKind::usage, "there is no paper '" + request.paper + "' (" + known + "all)");
  }

  std::vector<Task<PaperPoint>> tasks;
  for (const Paper& paper : subject->papers)
    for (const PublishedTable& table : paper.tables)
      for (const PublishedRow& row : table.rows) {
        const BenchScene& scene = subject->scenes.of(row.scene);
        const Size size = sizeOf(paper, request);
        PaperKey key;
        static_cast<PointKey<>&>(key) = pointKey(setup.bench.describe(scene, row.settings), scene, paper.name);
        key.size = size;
        key.row = table.name + ": " + row.label;
        tasks.push_back({.key = std::move(key),
                         .label = paper.name + ", " + table.name + ", " + row.label,
                         .work = workOf(kFrames, scene.model.scene.triangles.size()),
                         .measure = [subject, &bench = setup.bench, &folder = setup.folder, &scene, &paper, &row, size,
                                     quick = request.quick] {
                           return measure(bench, folder, scene, row, size, quick, paperPicture(paper, row));
                         }});
      }
  const auto report = [subject, &folder = setup.folder](const std::vector<PaperPoint>& points) {
    return Report{.title = "What the papers say, and what is measured here",
                  .tables = {{"paper", paperCsv(subject->papers, points)}},
                  .chart = std::nullopt,
                  .body = paperBody(subject->papers, subject->scenes.standIns, points, folder),
                  .summary = paperSummary(subject->papers, points)};
  };
  return makePlan<PaperPoint>(std::move(tasks), report);
}

}  // namespace

Mode paperMode() {
  return {.name = "paper",
          .description = "The papers' own tables and figures, their numbers beside those measured here",
          .takesPaper = true,
          .plan = planPaper};
}

}  // namespace halfsilver::bench
