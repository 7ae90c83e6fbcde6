#include "passes/target_draw.h"

#include "gl/draw_state.h"

namespace halfsilver {

gl::Program TargetDraw::program(std::string_view fragment, std::vector<gl::Define> defines, bool depth) const {
  if (depth) defines.push_back({"TARGET_DEPTH"});
  return gl::Program::raster(*api_, "passes/fullscreen.vert", fragment, defines);
}

void TargetDraw::run(const FrameView& view, const gl::Program& program, const Target& target) const {
  const bool depth = target.depth != DepthUse::none, reversed = target.depth == DepthUse::reversed;
  program.set("origin", glm::vec2(target.x, target.y));
  if (depth) program.set("reversedDepth", static_cast<int>(reversed));
  program.use();
  view.constants.bindUniform(UBO_FRAME);
  if (depth) view.gbuffer.depth.bind(UNIT_DEPTH);
  api_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer);
  vertexArray_.bind();
  // What is as far as the cleared depth, the sky for one, is drawn.
  gl::DrawState{.viewport = {target.x, target.y, target.width, target.height},
                .depthTest = depth,
                .depthFunction = static_cast<GLenum>(reversed ? GL_GEQUAL : GL_LEQUAL),
                .depthWrite = depth}
      .apply(*api_);
  api_->DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace halfsilver
