#pragma once

#include <halfsilver/frame_view.h>
#include <halfsilver/settings.h>
#include "gl/program.h"

namespace halfsilver {

// Colors of the pixels that PrimarySettings leave without a surface (INTERPOLATED), from those around
// them: Robert et al. 2007, section 3.1. After everything else has its light; writes GBuffer::shaded. Section
// "composite".
class InterpolatePass {
 public:
  explicit InterpolatePass(const gl::Api& api) : api_(&api) {}

  void run(const FrameView& view, const PrimarySettings& primary);

 private:
  const gl::Api* api_;
  gl::Program program_;  // made on first use
};

}  // namespace halfsilver
