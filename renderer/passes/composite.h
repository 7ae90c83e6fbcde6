#pragma once

#include <glm/glm.hpp>

#include <halfsilver/frame_view.h>
#include "gl/framebuffer.h"
#include "gl/program.h"

namespace halfsilver {

// Blends deferred shading and reflection into a framebuffer of the G-buffer's size, section "composite".
class CompositePass {
 public:
  enum class Output {
    display,     // exposed, tone mapped, sRGB-encoded by the shader, dithered: for plain 8-bit color
    undithered,  // the same for float color
    linear       // radiance: for float color
  };

  explicit CompositePass(const gl::Api& api);

  // Draws to color output 0 of `framebuffer` with its lower left corner at `origin`. Alpha is 1.
  void run(const FrameView& view, const GBuffer& gbuffer, Output output, GLuint framebuffer, const glm::ivec2& origin);

 private:
  const gl::Api* api_;
  gl::Program display_, undithered_, linear_;  // the second is made when first used
  gl::EmptyVertexArray vertexArray_;
};

}  // namespace halfsilver
