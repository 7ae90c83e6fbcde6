#pragma once

#include <cstdint>

#include "effects/camera_rays.h"

namespace halfsilver {

// Ambient occlusion (Hu et al. 2014, section 4): how much of an evenly bright sky reaches each surface, 0..1, as its
// light. Rays in directions as often as the cosine says, of which any hit within effect.radius stops one.
class OcclusionEffect final : public RayEffect {
 public:
  explicit OcclusionEffect(const gl::Api& api);

  int batches(const FrameView& view, const Settings& settings, std::uint32_t maxRays) const override;
  int generations(const Settings&) const override { return 2; }
  bool bringsAllLight() const override { return true; }
  bool startsAtCamera() const override { return true; }
  bool showsLayers() const override { return true; }  // it shows no materials at all
  bool asksForAnyHit(int generation) const override { return generation > 0; }
  void spawn(const FrameView& view, int batch, int batches, RayQueue& out, EffectFrame& frame) override {
    camera_.spawn(view, batch, batches, out, frame);
  }
  void firstHits(const FrameView& view, const RayQueue& rays, Hits& hits) override {
    camera_.firstHits(view, rays, hits);
  }
  // Section "shade".
  void shade(const FrameView& view, const Settings& settings, const RayQueue& rays, const Hits& hits,
             const RayStep& step, RayQueue* next, EffectFrame& frame) override;
  void resolve(const FrameView& view, const Settings& settings, const RayQueue& first, const RayPasses& passes,
               int batch, EffectFrame& frame, GBuffer& gbuffer) override {
    camera_.resolve(view, frame, first, passes, settings.effect.samples, batch, gbuffer);
  }
  std::uint64_t bytes() const override { return camera_.bytes(); }

 private:
  CameraRays camera_;
  gl::Program scatter_, gather_;
};

}  // namespace halfsilver
