#pragma once

#include <cstddef>

#include <halfsilver/frame_view.h>
#include "passes/target_draw.h"

namespace halfsilver {

// Blends deferred shading and reflection into a target, section "composite".
class CompositePass {
 public:
  enum class Output {
    display,     // exposed, tone mapped, sRGB-encoded by the shader, dithered: for plain 8-bit color
    undithered,  // the same for float color
    linear       // radiance: for float color
  };

  explicit CompositePass(const gl::Api& api);

  // Draws to color output 0 of a target of the G-buffer's size. Alpha is 1.
  void run(const FrameView& view, Output output, const Target& target);

 private:
  static constexpr std::size_t kOutputs = 3;
  TargetDraw draw_;
  gl::Program programs_[kOutputs][2];  // [output][depth]; those that most frames need are made at once
};

}  // namespace halfsilver
