#include "effects/whitted/whitted_effect.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "shared/passes/light_sums.h"
#include "shared/passes/shadow_marks.h"

namespace halfsilver {
namespace {

// What a pixel may send in a generation, on average over a band: a scene of glass alone, whose paths branch at every
// surface, sends more at the end of its depth.
std::uint32_t raysPerPixel(const FrameView& view) { return 6 + 3 * view.frame.directLights; }

}  // namespace

WhittedEffect::WhittedEffect(const gl::Api& api) : CameraEffect(api), api_(&api) {}

int WhittedEffect::batches(const FrameView& view, const Settings&, std::uint32_t maxRays) const {
  return cameraBatches(view.gbuffer, raysPerPixel(view), maxRays);
}

// The camera's hits, those of the depth, and what their rays to lights meet.
int WhittedEffect::generations(const Settings& settings, const shared::FrameConstants&) const {
  return 1 + settings.trace.bounces + 1 + kPassedSurfaces;
}

const gl::Program& WhittedEffect::shading(const GpuScene& scene, Origin origin, bool surfaces, bool last) {
  std::optional<SurfacePrograms>& programs = shade_[static_cast<std::size_t>(origin)][surfaces][last];
  if (!programs) {
    std::vector<gl::Define> defines;
    if (origin != Origin::hit) defines.push_back({"CAMERA_HITS"});
    if (origin == Origin::markedCamera) defines.push_back({"SHADOW_MARKS"});
    if (surfaces) defines.push_back({"HIT_SURFACES"});
    if (last) defines.push_back({"LAST_GENERATION"});
    programs.emplace(*api_, "effects/whitted/shade.comp", std::move(defines));
  }
  return programs->of(scene);
}

void WhittedEffect::shade(const FrameView& view, const Settings& settings, const RayQueue& rays, const Hits& hits,
                          const RayStep& step, RayQueue* next, EffectFrame& frame) {
  const auto section = view.profiler.section("shade");
  const bool camera = step.generation == 0, surfaces = static_cast<bool>(hits.surfaces);
  const bool marked = camera && view.gbuffer.shadowMarks;
  const Origin origin = marked ? Origin::markedCamera : camera ? Origin::camera : Origin::hit;
  const gl::Program& program = shading(view.scene, origin, surfaces, next == nullptr);
  // All generations have the room that the first one asks for, as far as a storage block has it.
  const std::uint64_t wanted = std::uint64_t{rays.capacity} * raysPerPixel(view);
  const std::uint64_t most = static_cast<std::uint64_t>(api_->limits.storageBlockBytes) / sizeof(shared::Ray);
  const auto room = camera ? static_cast<std::uint32_t>(std::min(wanted, most)) : rays.capacity;
  cameraRays().bind(program, view, frame, rays, step, next, room);
  program.set("pass", step.pass);
  program.set("endsHere", step.generation >= settings.trace.bounces ? 1u : 0u);
  view.scene.bindSurfaces();
  view.shadows.bind();
  if (marked) view.gbuffer.shadowMarks.bind(UNIT_SHADOW_MARKS);
  view.scene.sky.bind(UNIT_SKY);
  hits.hits.bindStorage(SSBO_HITS);
  if (surfaces) hits.surfaces.bindStorage(SSBO_HIT_SURFACES);
  cameraRays().dispatch(rays, next);
}

}  // namespace halfsilver
