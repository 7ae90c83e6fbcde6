#include "apps/render_job.h"

#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include <halfsilver/methods.h>
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

ChoiceKey keyOf(const RenderJob& job, const Camera& camera, const Settings& settings, bool moves) {
  const RunStatistics& run = job.statistics;
  ChoiceKey key{.device = run.device.renderer,
                .version = run.device.version,
                .methods = {},
                .scene = run.sceneFile,
                .triangles = run.triangles,
                .width = run.width,
                .height = run.height,
                .moves = moves,
                .rest = {}};
  for (const MethodInfo& method : methods())
    if (method.exact && job.renderer.traces(method.name)) key.methods += (key.methods.empty() ? "" : ",") + method.name;
  if (std::error_code error; !key.scene.starts_with("builtin:"))
    if (const auto whole = std::filesystem::canonical(key.scene, error); !error) key.scene = whole.string();
  for (const SettingInfo& info : describe(settings)) key.rest += info.value + ' ';
  for (const glm::vec3& place : {camera.eye, camera.target})
    for (int axis = 0; axis < 3; ++axis) key.rest += std::to_string(place[axis]) + ' ';
  for (const Material& material : job.view.model.scene.materials)
    key.rest += std::to_string(material.mirror.value_or(-1)) + ' ';
  return key;
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
  const CalibrationInputs inputs{
      .camera = camera, .settings = settings, .target = job.target.target(), .advance = advance};
  std::optional<MethodChoice>& choice = job.statistics.choice;
  if (run.device.software)
    choice = job.renderer.traces("exact") ? chooseMethod(job.renderer, inputs)
                                          : MethodChoice{"identity", "the device draws in software", {}};
  else
    choice = rememberedChoice(choicesFile(), keyOf(job, camera, settings, static_cast<bool>(advance)), [&] {
      MethodChoice chosen = chooseMethod(job.renderer, inputs);
      if (job.renderer.report().selected == 0) chosen.measured.clear();  // where nothing is traced nothing is learned
      return chosen;
    });
  settings.trace.method = choice->method;
}

void warnOfLosses(const FrameReport& report, std::vector<std::string>& warnings) {
  if (report.overflow > 0) addWarnings({std::to_string(report.overflow) + " rays were given up (hit.T -3)"}, warnings);
  if (report.lostFragments > 0)
    addWarnings({std::to_string(report.lostFragments) + " fragments did not fit into the A-buffer"}, warnings);
}

}  // namespace halfsilver
