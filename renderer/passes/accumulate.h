#pragma once

#include <halfsilver/frame_view.h>
#include "gl/program.h"

namespace halfsilver {

// Adds the light of a frame, as the composite pass would show it, to a picture of several samples, section
// "composite". Frames are added in the order of the calls, so equal samples give equal sums.
class AccumulatePass {
 public:
  explicit AccumulatePass(const gl::Api& api) : api_(&api) {}

  // Allocates `out` if its size is not the frame's. An empty picture begins with this frame.
  void run(const FrameView& view, Accumulation& out);

 private:
  const gl::Api* api_;
  gl::Program program_;  // made when first used
};

}  // namespace halfsilver
