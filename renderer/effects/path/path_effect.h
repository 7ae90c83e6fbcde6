#pragma once

#include <cstdint>
#include <optional>

#include "effects/camera_rays.h"
#include "effects/energy_table.h"
#include "frame/surface_programs.h"

namespace halfsilver {

// Path tracing (Kajiya 1986; Hu et al. 2014, section 4): at each surface of a path one ray to a light that is chosen
// and one that the surface scatters, joined by their densities (Veach & Guibas 1995).
class PathEffect final : public RayEffect {
 public:
  explicit PathEffect(const gl::Api& api);

  int batches(const FrameView& view, const Settings& settings, std::uint32_t maxRays) const override;
  // Surfaces after the camera's: trace.bounces, then what their rays find.
  int generations(const Settings& settings) const override { return settings.trace.bounces + 2; }
  bool bringsAllLight() const override { return true; }
  bool startsAtCamera() const override { return true; }
  bool showsLayers() const override { return true; }
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
  std::uint64_t bytes() const override { return camera_.bytes() + energy_.bytes(); }

 private:
  const gl::Program& shading(const GpuScene& scene, bool camera, bool last);

  const gl::Api* api_;
  CameraRays camera_;
  EnergyTable energy_;
  std::optional<SurfacePrograms> shade_[3];  // made on first use: the camera's hits, later ones, the last
};

}  // namespace halfsilver
