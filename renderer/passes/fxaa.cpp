#include "passes/fxaa.h"

#include "gl/draw_state.h"
#include "shared/passes/display.h"

namespace halfsilver {

GLuint FxaaPass::source(int width, int height) {
  if (!picture_ || picture_.shape().width != width || picture_.shape().height != height) {
    picture_ = gl::Texture();  // the old memory goes before the new comes
    picture_ = gl::Texture(*api_, {.format = GL_RGBA16F, .width = width, .height = height}, "display values");
    picture_.parameter(GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    picture_.parameter(GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    framebuffer_.attach(GL_COLOR_ATTACHMENT0, picture_);
  }
  return framebuffer_.name();
}

void FxaaPass::run(const FrameView& view, GLuint framebuffer, const glm::ivec2& origin) {
  if (!program_) program_ = gl::Program::raster(*api_, "passes/fullscreen.vert", "passes/fxaa.frag");
  const auto section = view.profiler.section("composite");
  program_.set("origin", glm::vec2(origin));
  program_.use();
  view.constants.bindUniform(UBO_FRAME);
  picture_.bind(UNIT_PICTURE);
  api_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  vertexArray_.bind();
  gl::DrawState{.viewport = {origin, picture_.shape().width, picture_.shape().height}}.apply(*api_);
  api_->DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace halfsilver
