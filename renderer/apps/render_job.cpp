#include "apps/render_job.h"

#include <string_view>
#include <utility>

#include "apps/drawing.h"
#include "apps/exposure.h"
#include "apps/method_choice.h"

namespace halfsilver {
namespace {

RunStatistics describeRun(const ViewRequest& request, const ViewArguments& arguments, Settings settings,
                          const PosedView& view) {
  const Model& model = view.model;
  RunStatistics statistics;
  statistics.settings = std::move(settings);
  statistics.sceneFile = request.scene;
  statistics.triangles = model.scene.triangles.size();
  statistics.vertices = model.scene.vertices.size();
  statistics.materials = model.scene.materials.size();
  statistics.textures = model.scene.textures.size();
  statistics.lights = model.scene.lights.size();
  statistics.diagonal = view.bounds.diagonal();
  statistics.width = arguments.size.width;
  statistics.height = arguments.size.height;
  statistics.warnings = model.warnings;
  return statistics;
}

std::string valueOf(const Settings& settings, std::string_view name) {
  for (const SettingInfo& info : describe(settings))
    if (info.name == name) return info.value;
  return {};
}

}  // namespace

RenderJob::RenderJob(const ViewRequest& request, const ViewArguments& arguments, Settings settings, PosedView loaded,
                     Progress& progress, WallClock& clock)
    : view(std::move(loaded)),
      statistics(describeRun(request, arguments, std::move(settings), view)),
      context(openContext(request.context, request.device, statistics.warnings)),
      api(gl::Api::load(context.getProcAddress())),
      target(api, arguments.size),
      renderer(context.getProcAddress(), exactFactory(view.model.scene, request.threads)) {
  keepFreedMemory();
  statistics.device = renderer.device();
  statistics.context = context.name();
  clock.lap("context");
  progress.show("uploading " + std::to_string(statistics.triangles) + " triangles");
  show(view, renderer);
  clock.lap("upload");
}

void exposeFor(RenderJob& job, const Camera& camera, Settings& settings) {
  Settings once = settings;
  once.effect.passes = 1;
  once.effect.progressive = false;
  job.renderer.render(camera, once, job.target.target());
  settings.image.exposure = automaticExposure(job.renderer.readLayers()).value_or(settings.image.exposure);
  job.renderer.forgetHistory();
}

void decideMethod(RenderJob& job, const Camera& camera, Settings& settings, const std::function<void(int)>& advance) {
  if (settings.trace.method != "auto") return;
  const RunStatistics& run = job.statistics;
  const ChoiceKey key{.device = run.device.renderer,
                      .version = run.device.version,
                      .scene = run.sceneFile,
                      .triangles = run.triangles,
                      .width = run.width,
                      .height = run.height,
                      .moves = static_cast<bool>(advance),
                      .effect = valueOf(settings, "trace.effect"),
                      .bounces = settings.trace.bounces};
  job.statistics.choice = rememberedChoice(choicesFile(), key, [&] {
    return chooseMethod(job.renderer,
                        {.camera = camera, .settings = settings, .target = job.target.target(), .advance = advance});
  });
  settings.trace.method = job.statistics.choice->method;
}

void warnOfLosses(const FrameReport& report, std::vector<std::string>& warnings) {
  if (report.overflow > 0) addWarnings({std::to_string(report.overflow) + " rays were given up (hit.T -3)"}, warnings);
  if (report.lostFragments > 0)
    addWarnings({std::to_string(report.lostFragments) + " fragments did not fit into the A-buffer"}, warnings);
}

}  // namespace halfsilver
