#pragma once

#include <cstdint>
#include <optional>

#include "effects/camera_rays.h"
#include "frame/surface_programs.h"

namespace halfsilver {

// Ambient occlusion (Hu et al. 2014, section 4): how much of an evenly bright sky reaches each surface, 0..1, as its
// light. Rays in directions as often as the cosine says, of which any hit within effect.radius stops one.
class OcclusionEffect final : public CameraEffect {
 public:
  explicit OcclusionEffect(const gl::Api& api);

  int batches(const FrameView& view, const Settings& settings, std::uint32_t maxRays) const override;
  // The camera's surfaces, what their rays find, and what is behind surfaces that blend.
  int generations(const Settings&, const shared::FrameConstants& frame) const override {
    return frame.blends != 0 ? 2 + kPassedSurfaces : 2;
  }
  bool showsClear(const Settings&) const override { return true; }  // it shows no materials at all
  bool showsDispersion() const override { return true; }
  bool showsCoats() const override { return true; }
  bool asksForAnyHit(int generation, const shared::FrameConstants& frame) const override {
    return generation > 0 && frame.blends == 0;
  }
  // Section "shade".
  void shade(const FrameView& view, const Settings& settings, const RayQueue& rays, const Hits& hits,
             const RayStep& step, RayQueue* next, EffectFrame& frame) override;

 private:
  int samplesPerPass(const Settings& settings) const override { return settings.effect.samples; }
  const gl::Program& blending(const GpuScene& scene, bool camera, bool last);

  const gl::Api* api_;
  gl::Program scatter_, gather_;
  std::optional<SurfacePrograms> blending_[3];  // made on first use: the camera's hits, later ones, the last
};

}  // namespace halfsilver
