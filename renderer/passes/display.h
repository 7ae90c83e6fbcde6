#pragma once

#include <halfsilver/frame_view.h>
#include "passes/target_draw.h"

namespace halfsilver {

// Shows a picture of radiance, section "composite".
class DisplayPass {
 public:
  explicit DisplayPass(const gl::Api& api) : draw_(api) {}

  struct Source {
    const gl::Texture& picture;
    float scale = 1;  // times the picture
  };
  enum class Output { display, linear };  // as CompositePass::Output

  // Draws to color output 0 of a target of the source's size.
  void run(const FrameView& view, const Source& source, Output output, const Target& target);

 private:
  TargetDraw draw_;
  gl::Program programs_[2][2];  // [linear][depth], made when first used
};

}  // namespace halfsilver
