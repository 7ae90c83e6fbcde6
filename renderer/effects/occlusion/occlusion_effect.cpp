#include "effects/occlusion/occlusion_effect.h"

namespace halfsilver {

OcclusionEffect::OcclusionEffect(const gl::Api& api)
    : CameraEffect(api),
      scatter_(gl::Program::compute(api, "effects/occlusion/scatter.comp")),
      gather_(gl::Program::compute(api, "effects/occlusion/gather.comp")) {}

int OcclusionEffect::batches(const FrameView& view, const Settings& settings, std::uint32_t maxRays) const {
  return cameraBatches(view.gbuffer, static_cast<std::uint32_t>(settings.effect.samples), maxRays);
}

void OcclusionEffect::shade(const FrameView& view, const Settings& settings, const RayQueue& rays, const Hits& hits,
                            const RayStep& step, RayQueue* next, EffectFrame& frame) {
  const auto section = view.profiler.section("shade");
  const auto samples = static_cast<std::uint32_t>(settings.effect.samples);
  const gl::Program& program = step.generation == 0 ? scatter_ : gather_;
  cameraRays().bind(program, view, frame, rays, step, next,
                    bandOf(view.gbuffer, step.batch, frame.batches).pixels * samples);
  view.scene.bindTriangles();
  if (step.generation == 0) {
    program.set("firstSample", step.pass * samples);
  } else {
    hits.hits.bindStorage(SSBO_HITS);
  }
  cameraRays().dispatch(rays, next);
}

}  // namespace halfsilver
