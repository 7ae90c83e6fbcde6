#pragma once

#include <halfsilver/gl/profiler.h>
#include <halfsilver/products.h>
#include "gl/program.h"

namespace halfsilver {

// Pixels whose reflection is traced: all with a surface, or those that reflect more than a threshold, or none, thinned
// to a fraction that is scattered evenly or lies around the centre, and to those whose reflection contributes enough to
// the shaded picture (FrameConstants). The counts stay on the GPU.
class SelectPass {
 public:
  explicit SelectPass(const gl::Api& api);

  // Section "select"; the G-buffer is shaded. `out` is allocated anew where the G-buffer's pixels exceed its capacity.
  // UBO_FRAME and the sky are bound by the caller; units of material textures are bound anew.
  void run(const GBuffer& gbuffer, RayQueue& out, Contributions& contributions, gl::Profiler& profiler);

 private:
  const gl::Api* api_;
  gl::Program select_, finish_;
};

}  // namespace halfsilver
