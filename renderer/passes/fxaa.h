#pragma once

#include <halfsilver/frame_view.h>
#include "passes/target_draw.h"

namespace halfsilver {

// Smooths the edges of a tone-mapped picture by what it shows alone (image.antialiasing = fxaa), section "composite".
class FxaaPass {
 public:
  explicit FxaaPass(const gl::Api& api) : api_(&api), draw_(api), framebuffer_(api) {}

  // What takes the picture as CompositePass::Output::undithered has it.
  Target source(int width, int height);
  // Draws it to color output 0 of a target of its size.
  void run(const FrameView& view, const Target& target);

  std::size_t bytes() const { return picture_.bytes(); }
  void forget() { picture_ = gl::Texture(); }

 private:
  const gl::Api* api_;
  TargetDraw draw_;
  gl::Program programs_[2];  // [depth], made when first used
  gl::Texture picture_;
  gl::Framebuffer framebuffer_;
};

}  // namespace halfsilver
