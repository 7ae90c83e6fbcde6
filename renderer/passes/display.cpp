#include "passes/display.h"

#include <vector>

#include "gl/draw_state.h"
#include "shared/passes/display.h"

namespace halfsilver {

void DisplayPass::run(const FrameView& view, const Source& source, Output output, GLuint framebuffer,
                      const glm::ivec2& origin) {
  gl::Program& program = programs_[output == Output::linear][source.second != nullptr];
  if (!program) {
    std::vector<gl::Define> defines;
    if (output == Output::linear) defines.push_back({"LINEAR"});
    if (source.second) defines.push_back({"IN_TWO_PARTS"});
    program = gl::Program::raster(*api_, "passes/fullscreen.vert", "passes/display.frag", defines);
  }
  const auto section = view.profiler.section("composite");
  program.set("origin", glm::vec2(origin));
  program.set("scale", source.scale);
  program.use();
  view.constants.bindUniform(UBO_FRAME);
  source.first.bind(UNIT_PICTURE);
  if (source.second) source.second->bind(UNIT_REFLECTED);
  api_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  vertexArray_.bind();
  gl::DrawState{.viewport = {origin, source.first.shape().width, source.first.shape().height}}.apply(*api_);
  api_->DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace halfsilver
