#pragma once

#include <glm/glm.hpp>

#include <halfsilver/frame_view.h>
#include "gl/framebuffer.h"
#include "gl/program.h"

namespace halfsilver {

// Shows a picture of radiance, section "composite".
class DisplayPass {
 public:
  explicit DisplayPass(const gl::Api& api) : api_(&api), vertexArray_(api) {}

  // The picture is `scale` times the sum of the parts.
  struct Source {
    const gl::Texture& first;
    const gl::Texture* second = nullptr;  // of the same size; none if null
    float scale = 1;
  };
  enum class Output { display, linear };  // as CompositePass::Output

  // Draws to color output 0 of `framebuffer` with its lower left corner at `origin`.
  void run(const FrameView& view, const Source& source, Output output, GLuint framebuffer, const glm::ivec2& origin);

 private:
  const gl::Api* api_;
  gl::Program programs_[2][2];  // [linear][two parts], made when first used
  gl::EmptyVertexArray vertexArray_;
};

}  // namespace halfsilver
