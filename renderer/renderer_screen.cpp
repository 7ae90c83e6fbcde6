#include "renderer_screen.h"

#include "effects/ray_queues.h"

namespace halfsilver {

void ScreenLook::run(const FrameView& view, RayEffect& effect, EffectFrame& frame, GBuffer& gbuffer) {
  if (!tracer_) {
    Settings settings;
    settings.trace.method = "screen-space";
    tracer_ = makeTracer(*api_, settings, {});
  }
  tracer_->update(view, {});
  const auto answer = [&](const RayQueue& rays, Hits& hits) {
    reserveHits(*api_, rays, tracer_->storesAttributes(), hits);
    tracer_->trace(view, rays, hits);
  };
  effect.lookAtScreen(view, answer, frame, gbuffer);
}

std::uint64_t ScreenLook::bytes() const {
  if (!tracer_) return 0;
  const TracerMemory memory = tracer_->memory();
  return memory.structureTotal + memory.transient;
}

}  // namespace halfsilver
