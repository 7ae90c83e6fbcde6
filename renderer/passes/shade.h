#pragma once

#include <halfsilver/frame_view.h>
#include "gl/program.h"

namespace halfsilver {

// Deferred shading, section "shade": writes GBuffer::shaded, the radiance of every pixel without its reflection, with
// the visible share of the sky in alpha, and empties GBuffer::reflection and GBuffer::seen. What the first two held of
// the surfaces is gone then, but for GBuffer::occlusion. Pixels without a surface show the sky. With
// GBuffer::shadowMarks, lights that are in doubt at a pixel are left out there.
class ShadePass {
 public:
  explicit ShadePass(const gl::Api& api);

  void run(const FrameView& view, const GBuffer& gbuffer) { run(view, gbuffer, 0, gbuffer.height); }
  void run(const FrameView& view, const GBuffer& gbuffer, int firstRow, int rows);

 private:
  const gl::Api* api_;
  // [with marks][GpuScene::lobes][with coats][with GBuffer::seen]; that without is made at once, the others on first
  // use
  gl::Program programs_[2][2][2][2];
};

}  // namespace halfsilver
