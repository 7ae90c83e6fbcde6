#pragma once

#include <cstdint>

#include "effects/camera_rays.h"

namespace halfsilver {

// Ambient occlusion (Hu et al. 2014, section 4): how much of an evenly bright sky reaches each surface, 0..1, as its
// light. Rays in directions as often as the cosine says, of which any hit within effect.radius stops one.
class OcclusionEffect final : public CameraEffect {
 public:
  explicit OcclusionEffect(const gl::Api& api);

  int batches(const FrameView& view, const Settings& settings, std::uint32_t maxRays) const override;
  int generations(const Settings&, bool) const override { return 2; }
  bool showsLayers() const override { return true; }  // it shows no materials at all
  bool asksForAnyHit(int generation) const override { return generation > 0; }
  // Section "shade".
  void shade(const FrameView& view, const Settings& settings, const RayQueue& rays, const Hits& hits,
             const RayStep& step, RayQueue* next, EffectFrame& frame) override;

 private:
  int samplesPerPass(const Settings& settings) const override { return settings.effect.samples; }
  gl::Program scatter_, gather_;
};

}  // namespace halfsilver
