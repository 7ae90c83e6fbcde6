#pragma once

#include <cstdint>
#include <memory>

#include <halfsilver/frame_view.h>
#include <halfsilver/tracer.h>
#include "effects/ray_effect.h"

namespace halfsilver {

// Has the screen answer what an effect asks it (RayEffect::lookAtScreen), whatever method traces the frame. The tracer
// for that is made when it is first needed, and stays.
class ScreenLook {
 public:
  explicit ScreenLook(const gl::Api& api) : api_(&api) {}

  void run(const FrameView& view, RayEffect& effect, EffectFrame& frame, GBuffer& gbuffer);
  std::uint64_t bytes() const;

 private:
  const gl::Api* api_;
  std::unique_ptr<Tracer> tracer_;
};

}  // namespace halfsilver
