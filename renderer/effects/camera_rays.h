#pragma once

#include <cstdint>
#include <vector>

#include "effects/ray_effect.h"
#include "effects/ray_queues.h"
#include "gl/program.h"

namespace halfsilver {

// What effects share whose first rays are the camera's and whose light is a sum per pixel: of all pixels that show a
// surface, thinned to select.fraction; none if select.mode is none.
class CameraRays {
 public:
  explicit CameraRays(const gl::Api& api);

  // Section "select".
  void spawn(const FrameView& view, int batch, int batches, RayQueue& out, EffectFrame& frame) const;
  void firstHits(const FrameView& view, const RayQueue& rays, const Hits& hits) const;

  // Before the shading of a step: what shaders/effects/common/light_sums.glsl reads, and send_on.glsl if there is a
  // next queue, with room for `nextRays`. The sums begin with the first pass of all.
  void bind(const gl::Program& program, const FrameView& view, const EffectFrame& frame, const RayQueue& rays,
            const RayStep& step, RayQueue* next, std::uint32_t nextRays);
  // One invocation per ray of the queue, then what it wrote is ready to be read.
  void dispatch(const RayQueue& rays, const RayQueue* next) const;

  // The mean of all passes so far, of `samples` each.
  void resolve(const FrameView& view, const EffectFrame& frame, const RayQueue& first, const RayPasses& passes,
               int samples, int batch, const GBuffer& gbuffer) const;

  std::uint64_t bytes() const;

 private:
  const gl::Api* api_;
  gl::Program spawn_, hits_, resolve_;
  RayCountPass count_;
  std::vector<gl::Buffer> sums_;  // LightSum per pixel of the band, by batch
};

// An effect of such rays.
class CameraEffect : public RayEffect {
 public:
  explicit CameraEffect(const gl::Api& api) : camera_(api) {}

  bool bringsAllLight() const final { return true; }
  bool startsAtCamera() const final { return true; }
  bool blends(const Settings&, const GpuScene& scene, bool seesBehind) const override {
    return scene.blendingMaterials > 0 && seesBehind;
  }
  void spawn(const FrameView& view, int batch, int batches, RayQueue& out, EffectFrame& frame) final {
    camera_.spawn(view, batch, batches, out, frame);
  }
  void firstHits(const FrameView& view, const RayQueue& rays, Hits& hits) final { camera_.firstHits(view, rays, hits); }
  void resolve(const FrameView& view, const Settings& settings, const RayQueue& first, const RayPasses& passes,
               int batch, EffectFrame& frame, GBuffer& gbuffer) final {
    camera_.resolve(view, frame, first, passes, samplesPerPass(settings), batch, gbuffer);
  }
  std::uint64_t bytes() const override { return camera_.bytes(); }

 protected:
  CameraRays& cameraRays() { return camera_; }
  // Of a pixel.
  virtual int samplesPerPass(const Settings&) const { return 1; }

 private:
  CameraRays camera_;
};

// Batches of which none sends more than `maxRays` at once if a pixel sends at most `raysPerPixel`.
int cameraBatches(const GBuffer& gbuffer, std::uint32_t raysPerPixel, std::uint32_t maxRays);

}  // namespace halfsilver
