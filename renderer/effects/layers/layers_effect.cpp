#include "effects/layers/layers_effect.h"

#include <vector>

namespace halfsilver {

const gl::Program& LayersEffect::shading(const GpuScene& scene, bool camera, bool last, bool xray) {
  std::optional<SurfacePrograms>& programs = shade_[camera][last][xray];
  if (!programs) {
    std::vector<gl::Define> defines;
    if (camera) defines.push_back({"CAMERA_HITS"});
    if (last) defines.push_back({"LAST_GENERATION"});
    if (xray) defines.push_back({"XRAY"});
    programs.emplace(*api_, "effects/layers/shade.comp", std::move(defines));
  }
  return programs->of(scene);
}

void LayersEffect::shade(const FrameView& view, const Settings& settings, const RayQueue& rays, const Hits& hits,
                         const RayStep& step, RayQueue* next, EffectFrame& frame) {
  const auto section = view.profiler.section("shade");
  const bool xray = settings.effect.transfer == Transfer::xray;
  const gl::Program& program = shading(view.scene, step.generation == 0, next == nullptr, xray);
  camera_.bind(program, view, frame, rays, step, next, rays.capacity);
  program.set("opacity", settings.effect.transfer == Transfer::blend ? 1.0f : settings.effect.opacity);
  view.scene.bindSurfaces();
  view.shadows.bind();
  view.scene.sky.bind(UNIT_SKY);
  hits.hits.bindStorage(SSBO_HITS);
  program.use();
  camera_.dispatch(rays, next);
}

}  // namespace halfsilver
