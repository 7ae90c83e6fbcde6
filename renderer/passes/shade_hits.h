#pragma once

#include <halfsilver/gl/profiler.h>
#include <halfsilver/products.h>
#include "gl/program.h"

namespace halfsilver {

// Shades the hits of one bounce with the lights and textures of the deferred pass, section "shade", and blends along
// the path as the composite pass does for pixels: at each hit (1 - W) of its shading, and W of what its reflected ray
// finds or, where the path ends, of the visible sky.
class ShadeHitsPass {
 public:
  explicit ShadeHitsPass(const gl::Api& api);

  // Empties GBuffer::reflection. Call once a frame before the first run(), and also where nothing is traced.
  void clear(const GBuffer& gbuffer, gl::Profiler& profiler) const;

  // Adds one bounce to GBuffer::reflection (alpha 1 where a ray was answered). A ray that was given up leaves its
  // pixel to the blend's fallback, or ends its path where it is not the first of it. `next` receives the rays of the
  // next bounce, with their count and dispatch; it must hold as many rays as `rays`, and is null in the last bounce.
  // GpuScene, ShadowMaps and UBO_FRAME are bound.
  void run(const RayQueue& rays, const Hits& hits, const GBuffer& gbuffer, RayQueue* next, gl::Profiler& profiler);

 private:
  const gl::Program& program(bool surfaces, bool next);

  const gl::Api* api_;
  gl::Program programs_[2][2];  // made on first use: [with HitSurface][with a next bounce]
  gl::Program finish_;
};

}  // namespace halfsilver
