#include "effects/layers/layers_effect.h"

#include <vector>

namespace halfsilver {

namespace {

// A surface that blends sends on two rays, one of which may do so again; more at once are counted as overflow.
constexpr std::uint32_t kRaysPerPixel = 4;

bool reflects(const Settings& settings) { return settings.effect.transfer == Transfer::blend; }

}  // namespace

int LayersEffect::batches(const FrameView& view, const Settings& settings, std::uint32_t maxRays) const {
  return cameraBatches(view.gbuffer, reflects(settings) ? kRaysPerPixel : 1, maxRays);
}

const gl::Program& LayersEffect::shading(const GpuScene& scene, bool camera, bool last, Transfer transfer) {
  std::optional<SurfacePrograms>& programs = shade_[camera][last][static_cast<std::size_t>(transfer)];
  if (!programs) {
    std::vector<gl::Define> defines;
    if (camera) defines.push_back({"CAMERA_HITS"});
    if (last) defines.push_back({"LAST_GENERATION"});
    if (transfer == Transfer::xray) defines.push_back({"XRAY"});
    if (transfer == Transfer::blend) defines.push_back({"REFLECTIONS"});
    programs.emplace(*api_, "effects/layers/shade.comp", std::move(defines));
  }
  return programs->of(scene);
}

void LayersEffect::shade(const FrameView& view, const Settings& settings, const RayQueue& rays, const Hits& hits,
                         const RayStep& step, RayQueue* next, EffectFrame& frame) {
  const auto section = view.profiler.section("shade");
  const gl::Program& program = shading(view.scene, step.generation == 0, next == nullptr, settings.effect.transfer);
  const bool reflections = reflects(settings);
  // The camera's queue has a ray per pixel, and later ones have the room that the first of them got.
  const std::uint32_t room = step.generation == 0 && reflections ? kRaysPerPixel * rays.capacity : rays.capacity;
  cameraRays().bind(program, view, frame, rays, step, next, room);
  view.scene.bindSurfaces();
  view.shadows.bind();
  view.scene.sky.bind(UNIT_SKY);
  hits.hits.bindStorage(SSBO_HITS);
  program.use();
  cameraRays().dispatch(rays, next);
}

}  // namespace halfsilver
