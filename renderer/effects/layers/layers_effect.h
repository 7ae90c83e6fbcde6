#pragma once

#include <cstdint>
#include <optional>

#include "effects/camera_rays.h"
#include "frame/surface_programs.h"

namespace halfsilver {

// Ray casting through all layers (Hu et al. 2014, section 4, figure 1a): the camera's rays go on behind each surface
// that they meet, which adds to the light from behind it and dims it by effect.transfer.
class LayersEffect final : public CameraEffect {
 public:
  explicit LayersEffect(const gl::Api& api) : CameraEffect(api), api_(&api) {}

  int batches(const FrameView& view, const Settings& settings, std::uint32_t maxRays) const override;
  int generations(const Settings& settings, const shared::FrameConstants&) const override {
    return settings.effect.layers;
  }
  bool blends(const Settings&, const GpuScene&, bool) const override { return true; }
  // Section "shade".
  void shade(const FrameView& view, const Settings& settings, const RayQueue& rays, const Hits& hits,
             const RayStep& step, RayQueue* next, EffectFrame& frame) override;

 private:
  const gl::Program& shading(const GpuScene& scene, bool camera, bool last, Transfer transfer);

  const gl::Api* api_;
  std::optional<SurfacePrograms> shade_[2][2][3];  // made on first use: [the camera's hits][the last layer][Transfer]
};

}  // namespace halfsilver
