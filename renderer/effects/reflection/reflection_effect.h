#pragma once

#include <optional>

#include "effects/ray_effect.h"
#include "effects/ray_queues.h"
#include "frame/surface_programs.h"
#include "gl/program.h"
#include "shared/passes/shade_hits.h"

namespace halfsilver {

// Mirror reflections: one ray per pixel whose reflection is traced, and one from each hit that reflects. With
// effect.glossy several per pixel, spread as the surface's roughness says, and smoothed over alike neighbors; and what
// is too rough to be traced, as a whole or in part, is looked for on the screen in the same way.
//
// Traced are all pixels with a surface, or those that reflect more than a threshold, or none (SelectSettings), thinned
// to a fraction that is scattered evenly or lies around the center, and to those whose reflection contributes enough to
// the shaded picture. Hits are shaded with the lights and textures of the deferred pass and blended along the path as
// the composite pass blends pixels: at each hit (1 - W) of its shading, and W of what its reflected ray finds or, at
// the end of the path, of the visible sky. A surface that blends sends its ray on behind it instead, and reflects the
// sky. Pixels of clear surfaces send a second ray, which is refracted; clear hits send on what is refracted or what is
// reflected, whichever is more.
class ReflectionEffect final : public RayEffect {
 public:
  explicit ReflectionEffect(const gl::Api& api);

  int generations(const Settings& settings, const shared::FrameConstants& frame) const override {
    return settings.trace.bounces + (frame.blends != 0 ? kBlended : 0) + (frame.transmission != 0 ? MOST_CLEAR : 0);
  }
  bool blends(const Settings& settings, const GpuScene& scene, bool seesBehind) const override {
    return scene.blendingMaterials > 0 && settings.select.mode != SelectMode::none && seesBehind;
  }
  int batches(const FrameView& view, const Settings& settings, std::uint32_t maxRays) const override {
    return bandCount(view.gbuffer, maxRays / perPixel(settings));
  }
  bool usesLightRays() const override { return true; }
  bool showsClear(const Settings& settings) const override { return settings.select.mode != SelectMode::none; }
  bool showsCoats() const override { return true; }
  bool storesFirstRays(const Settings& settings) const override { return settings.effect.glossy; }
  bool spawnReadsShading(const Settings& settings) const override { return settings.select.minContribution > 0; }
  // Section "select", as measure().
  void spawn(const FrameView& view, int batch, int batches, RayQueue& out, EffectFrame& frame) override;
  // Contributions, unless spawn() has counted them.
  void measure(const FrameView& view, const RayQueue& first, EffectFrame& frame) override;
  // Section "shade". A ray that was given up leaves its pixel to the blend's fallback, or ends its path if it is not
  // the first of it.
  void shade(const FrameView& view, const Settings&, const RayQueue& rays, const Hits& hits, const RayStep& step,
             RayQueue* next, EffectFrame& frame) override;
  // Section "shade": GBuffer::reflection, alpha 1 where a ray was answered.
  void resolve(const FrameView& view, const Settings& settings, const RayQueue& first, const RayPasses&, int batch,
               EffectFrame& frame, GBuffer& gbuffer) override;
  // The same for queues with several rays per pixel: the mean of those that were answered.
  void resolve(const FrameView& view, const RayQueue& first, const EffectFrame& frame, GBuffer& gbuffer,
               std::uint32_t slotsPerPixel, int batch = 0);
  // Sections "select" and "shade".
  void spawnBehind(const FrameView& view, int batch, int batches, RayQueue& out, EffectFrame& frame) override;
  void resolveBehind(const FrameView& view, const RayQueue& first, int batch, const EffectFrame& frame,
                     const GBuffer& gbuffer) override;
  bool looksAtScreen(const Settings& settings) const override {
    return settings.effect.glossy && settings.select.mode != SelectMode::none;
  }
  // GBuffer::seen, of all that is not traced as a whole.
  void lookAtScreen(const FrameView& view, const AnswerQueue& screen, EffectFrame& frame, GBuffer& gbuffer) override;

 private:
  // Surfaces that blend on a path, at most; one more is opaque.
  static constexpr int kBlended = 4;

  const gl::Program& shading(const FrameView& view, bool first, bool ofPixels, bool surfaces, bool next);
  static std::uint32_t perPixel(const Settings& settings) {
    return settings.effect.glossy ? static_cast<std::uint32_t>(settings.effect.samples) : 1;
  }
  void spawnPixels(const FrameView& view, const Band& band, int batch, RayQueue& out, EffectFrame& frame);
  void scatter(const FrameView& view, const RayQueue& pixels, RayQueue& out);
  void sendToScreen(const FrameView& view, const Band& band, RayQueue& out);
  void smooth(const FrameView& view, const gl::Program& program, EffectFrame& frame, gl::Texture& light) const;
  static void bindShaded(const FrameView& view);

  const gl::Api* api_;
  gl::Program spawn_, spawnByContribution_, contributions_;
  RayCountPass count_;
  gl::Program resolve_, resolveLightRays_, scatter_, filter_, look_, seen_, filterSeen_;  // but the first on first use
  // Made on first use: [first generation][queue of pixels][with HitSurface][with a next one]; [with light rays].
  std::optional<SurfacePrograms> shade_[2][2][2][2], spawnBehind_;
  gl::Program resolveBehind_[2];
};

}  // namespace halfsilver
