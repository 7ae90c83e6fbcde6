#pragma once

#include <cstdint>
#include <optional>

#include "effects/camera_rays.h"
#include "frame/surface_programs.h"

namespace halfsilver {

// Whitted 1980, "An Improved Illumination Model for Shaded Display" (Hu et al. 2014, section 4): at each surface rays
// to all lights, one that is reflected and one that is refracted, to the depth trace.bounces.
class WhittedEffect final : public CameraEffect {
 public:
  explicit WhittedEffect(const gl::Api& api);

  int batches(const FrameView& view, const Settings&, std::uint32_t maxRays) const override;
  int generations(const Settings& settings, const shared::FrameConstants&) const override;
  bool showsClear(const Settings&) const override { return true; }
  bool showsDispersion() const override { return true; }
  bool showsCoats() const override { return true; }
  bool readsShadowMarks() const override { return true; }
  // Section "shade".
  void shade(const FrameView& view, const Settings& settings, const RayQueue& rays, const Hits& hits,
             const RayStep& step, RayQueue* next, EffectFrame& frame) override;

 private:
  // Whose hits are shaded: rays of hits, the camera's, or those with GBuffer::shadowMarks.
  enum class Origin { hit, camera, markedCamera };
  const gl::Program& shading(const GpuScene& scene, Origin origin, bool surfaces, bool last);

  const gl::Api* api_;
  std::optional<SurfacePrograms> shade_[3][2][2];  // made on first use: [Origin][with HitSurface][last]
};

}  // namespace halfsilver
