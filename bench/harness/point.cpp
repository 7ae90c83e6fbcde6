#include "bench/harness/point.h"

#include <algorithm>
#include <utility>

#include "apps/program.h"

namespace halfsilver::bench {

PointKey<> pointKey(const RunStatistics& run, const BenchScene& scene, std::string preset) {
  const Camera& camera = scene.camera;
  return {version(),
          deviceOf(run),
          {run.sceneFile,
           run.triangles,
           run.vertices,
           run.materials,
           run.textures,
           run.lights,
           run.diagonal,
           scene.mirrors,
           {camera.eye, camera.target, glm::degrees(camera.verticalFov)}},
          run.settings,
          {run.width, run.height},
          std::move(preset)};
}

FrameRecord frameRecord(const RunStatistics& run) {
  const FrameReport& report = run.report;
  const double coverage =
      report.pixels > 0 ? static_cast<double>(report.selected) / static_cast<double>(report.pixels) : 0;
  return {{run.width, run.height, report.pixels, report.reflecting, report.selected, coverage},
          report.memory,
          report.overflow,
          report.lostFragments,
          run.warnings};
}

TimedFrame timedFrame(const RunStatistics& run) {
  TimedFrame frame{frameRecord(run), {}};
  const auto take = [&](const auto& stage) {
    const auto found =
        std::find_if(run.stages.begin(), run.stages.end(), [&](const StageSummary& s) { return s.stage == stage.key; });
    if (found != run.stages.end())
      frame.times.*stage.member = {found->median, found->min, found->max, found->runs, found->rejected};
  };
  std::apply([&](const auto&... stages) { (take(stages), ...); }, kFields<Times>);
  return frame;
}

Device deviceOf(const RunStatistics& run) {
  return {run.device.vendor, run.device.renderer, run.device.version, run.context, run.device.software};
}

}  // namespace halfsilver::bench
