#include "effects/path/path_effect.h"

#include <vector>

#include "shared/passes/path.h"

namespace halfsilver {
namespace {

// Of each sample in a generation: the path's next stretch, one to a light, and those sent before that pass surfaces.
std::uint32_t raysPerSample(const FrameView& view) { return view.frame.blends != 0 ? 2 + kPassedSurfaces : 2; }

}  // namespace

PathEffect::PathEffect(const gl::Api& api) : CameraEffect(api), api_(&api), energy_(api) {}

int PathEffect::batches(const FrameView& view, const Settings& settings, std::uint32_t maxRays) const {
  return cameraBatches(view.gbuffer, raysPerSample(view) * static_cast<std::uint32_t>(settings.effect.samples),
                       maxRays);
}

const gl::Program& PathEffect::shading(const GpuScene& scene, bool camera, bool last) {
  std::optional<SurfacePrograms>& programs = shade_[camera ? 0 : last ? 2 : 1];
  if (!programs) {
    std::vector<gl::Define> defines;
    if (camera) defines.push_back({"CAMERA_HITS"});
    if (last) defines.push_back({"LAST_GENERATION"});
    programs.emplace(*api_, "effects/path/shade.comp", std::move(defines));
  }
  return programs->of(scene);
}

void PathEffect::shade(const FrameView& view, const Settings& settings, const RayQueue& rays, const Hits& hits,
                       const RayStep& step, RayQueue* next, EffectFrame& frame) {
  const auto section = view.profiler.section("shade");
  const GpuScene& scene = view.scene;
  const auto samples = static_cast<std::uint32_t>(settings.effect.samples);
  const gl::Program& program = shading(scene, step.generation == 0, next == nullptr);
  const std::uint32_t room = bandOf(view.gbuffer, step.batch, frame.batches).pixels * raysPerSample(view) * samples;
  cameraRays().bind(program, view, frame, rays, step, next, room);
  program.set("generation", static_cast<unsigned>(step.generation));
  program.set("bounces", static_cast<unsigned>(settings.trace.bounces));
  program.set("firstSample", step.pass * samples);
  program.set("emitterCount", scene.emitters.count);
  program.set("skyRows", scene.skyTable.rows);
  program.set("skyColumns", scene.skyTable.columns);
  program.set("skyShines", scene.skyTable.shines ? 1u : 0u);
  scene.bindSurfaces();
  hits.hits.bindStorage(SSBO_HITS);
  view.shadows.lights.bind(UNIT_LIGHTS);
  scene.sky.bind(UNIT_SKY);
  scene.emitters.entries.bind(UNIT_EMITTERS);
  scene.skyTable.sums.bind(UNIT_SKY_TABLE);
  energy_.bind();
  program.use();
  cameraRays().dispatch(rays, next);
}

}  // namespace halfsilver
