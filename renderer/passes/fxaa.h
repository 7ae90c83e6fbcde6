#pragma once

#include <glm/glm.hpp>

#include <halfsilver/frame_view.h>
#include "gl/framebuffer.h"
#include "gl/program.h"

namespace halfsilver {

// Smooths the edges of a tone-mapped picture by what it shows alone (image.antialiasing = fxaa), section "composite".
class FxaaPass {
 public:
  explicit FxaaPass(const gl::Api& api) : api_(&api), framebuffer_(api), vertexArray_(api) {}

  // The framebuffer that takes the picture as CompositePass::Output::undithered has it.
  GLuint source(int width, int height);
  // Draws it to color output 0 of `framebuffer` with its lower left corner at `origin`.
  void run(const FrameView& view, GLuint framebuffer, const glm::ivec2& origin);

  std::size_t bytes() const { return picture_.bytes(); }
  void forget() { picture_ = gl::Texture(); }

 private:
  const gl::Api* api_;
  gl::Program program_;  // made when first used
  gl::Texture picture_;
  gl::Framebuffer framebuffer_;
  gl::EmptyVertexArray vertexArray_;
};

}  // namespace halfsilver
