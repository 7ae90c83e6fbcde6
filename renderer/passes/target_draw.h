#pragma once

#include <string_view>
#include <vector>

#include <halfsilver/frame_view.h>
#include <halfsilver/target.h>
#include "gl/framebuffer.h"
#include "gl/program.h"

namespace halfsilver {

// What passes share that draw over the rectangle of a target, with depth if the target has a use for it.
class TargetDraw {
 public:
  explicit TargetDraw(const gl::Api& api) : api_(&api), vertexArray_(api) {}

  // Of a fragment shader that includes lib/target.glsl. `depth`: for targets with a use for it.
  gl::Program program(std::string_view fragment, std::vector<gl::Define> defines, bool depth) const;
  // Draws to color output 0. The caller has bound what the shader reads besides the frame's constants.
  void run(const FrameView& view, const gl::Program& program, const Target& target) const;

 private:
  const gl::Api* api_;
  gl::EmptyVertexArray vertexArray_;
};

}  // namespace halfsilver
