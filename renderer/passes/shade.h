#pragma once

#include <halfsilver/gl/profiler.h>
#include <halfsilver/products.h>
#include "gl/program.h"

namespace halfsilver {

// Deferred shading, section "shade": writes GBuffer::shaded, the radiance of every pixel without its reflection, with
// the visible share of the sky in alpha. Pixels without a surface show the sky.
class ShadePass {
 public:
  explicit ShadePass(const gl::Api& api);

  // GpuScene, ShadowMaps and UBO_FRAME are bound.
  void run(const GBuffer& gbuffer, gl::Profiler& profiler) const;

 private:
  const gl::Api* api_;
  gl::Program program_;
};

}  // namespace halfsilver
