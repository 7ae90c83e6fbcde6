#pragma once

#include <halfsilver/frame_view.h>
#include "passes/target_draw.h"

namespace halfsilver {

// Shows a picture of radiance, section "composite".
class DisplayPass {
 public:
  explicit DisplayPass(const gl::Api& api) : draw_(api) {}

  // The picture is `scale` times the sum of the parts.
  struct Source {
    const gl::Texture& first;
    const gl::Texture* second = nullptr;  // of the same size; none if null
    float scale = 1;
  };
  enum class Output { display, linear };  // as CompositePass::Output

  // Draws to color output 0 of a target of the source's size.
  void run(const FrameView& view, const Source& source, Output output, const Target& target);

 private:
  TargetDraw draw_;
  gl::Program programs_[2][2][2];  // [linear][two parts][depth], made when first used
};

}  // namespace halfsilver
