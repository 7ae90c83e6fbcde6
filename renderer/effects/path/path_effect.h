#pragma once

#include <cstdint>
#include <optional>

#include "effects/camera_rays.h"
#include "effects/energy_table.h"
#include "frame/surface_programs.h"

namespace halfsilver {

// Path tracing (Kajiya 1986; Hu et al. 2014, section 4): at each surface of a path one ray to a light that is chosen
// and one that the surface scatters, joined by their densities (Veach & Guibas 1995).
class PathEffect final : public CameraEffect {
 public:
  explicit PathEffect(const gl::Api& api);

  int batches(const FrameView& view, const Settings& settings, std::uint32_t maxRays) const override;
  // Surfaces after the camera's: trace.bounces, those that are passed, then what their rays find.
  int generations(const Settings& settings, const shared::FrameConstants& frame) const override {
    return settings.trace.bounces + 2 + (frame.blends != 0 ? kPassedSurfaces : 0);
  }
  bool showsClear(const Settings&) const override { return true; }
  bool showsCoats() const override { return true; }
  // Section "shade".
  void shade(const FrameView& view, const Settings& settings, const RayQueue& rays, const Hits& hits,
             const RayStep& step, RayQueue* next, EffectFrame& frame) override;
  std::uint64_t bytes() const override { return CameraEffect::bytes() + energy_.bytes(); }

 private:
  int samplesPerPass(const Settings& settings) const override { return settings.effect.samples; }
  const gl::Program& shading(const GpuScene& scene, bool camera, bool last);

  const gl::Api* api_;
  EnergyTable energy_;
  std::optional<SurfacePrograms> shade_[3];  // made on first use: the camera's hits, later ones, the last
};

}  // namespace halfsilver
