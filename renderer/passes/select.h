#pragma once

#include "frame/products.h"
#include "gl/profiler.h"
#include "gl/program.h"

namespace halfsilver {

// Pixels whose reflection is traced: all with a surface, or those that reflect more than a threshold, or none, thinned
// to a fraction that is scattered evenly or lies around the centre (FrameConstants). The count stays on the GPU.
class SelectPass {
 public:
  explicit SelectPass(const gl::Api& api);

  // Section "select". `out` is allocated anew where the G-buffer's pixels exceed its capacity. UBO_FRAME is bound by
  // the caller.
  void run(const GBuffer& gbuffer, RayQueue& out, gl::Profiler& profiler);

 private:
  const gl::Api* api_;
  gl::Program select_, finish_;
};

}  // namespace halfsilver
