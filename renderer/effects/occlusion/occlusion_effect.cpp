#include "effects/occlusion/occlusion_effect.h"

#include <vector>

#include "shared/passes/light_sums.h"

namespace halfsilver {

OcclusionEffect::OcclusionEffect(const gl::Api& api)
    : CameraEffect(api),
      api_(&api),
      scatter_(gl::Program::compute(api, "effects/occlusion/scatter.comp")),
      gather_(gl::Program::compute(api, "effects/occlusion/gather.comp")) {}

int OcclusionEffect::batches(const FrameView& view, const Settings& settings, std::uint32_t maxRays) const {
  return cameraBatches(view.gbuffer, static_cast<std::uint32_t>(settings.effect.samples), maxRays);
}

const gl::Program& OcclusionEffect::blending(const GpuScene& scene, bool camera, bool last) {
  std::optional<SurfacePrograms>& programs = blending_[camera ? 0 : last ? 2 : 1];
  if (!programs) {
    std::vector<gl::Define> defines;
    if (camera) defines.push_back({"CAMERA_HITS"});
    if (last) defines.push_back({"LAST_GENERATION"});
    programs.emplace(*api_, "effects/occlusion/blend.comp", std::move(defines));
  }
  return programs->of(scene);
}

void OcclusionEffect::shade(const FrameView& view, const Settings& settings, const RayQueue& rays, const Hits& hits,
                            const RayStep& step, RayQueue* next, EffectFrame& frame) {
  const auto section = view.profiler.section("shade");
  const auto samples = static_cast<std::uint32_t>(settings.effect.samples);
  const bool blends = view.frame.blends != 0, first = step.generation == 0;
  const gl::Program& program = blends ? blending(view.scene, first, next == nullptr) : first ? scatter_ : gather_;
  cameraRays().bind(program, view, frame, rays, step, next,
                    bandOf(view.gbuffer, step.batch, frame.batches).pixels * samples);
  if (next) program.set("firstSample", step.pass * samples);
  if (blends) {
    if (next) program.set("generation", static_cast<unsigned>(step.generation));
    view.scene.bindSurfaces();
  } else {
    view.scene.bindTriangles();
  }
  if (blends || !first) hits.hits.bindStorage(SSBO_HITS);
  cameraRays().dispatch(rays, next);
}

}  // namespace halfsilver
