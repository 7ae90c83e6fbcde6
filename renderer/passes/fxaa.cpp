#include "passes/fxaa.h"

#include "shared/passes/display.h"

namespace halfsilver {

Target FxaaPass::source(int width, int height) {
  if (!picture_ || picture_.shape().width != width || picture_.shape().height != height) {
    picture_ = gl::Texture();  // the old memory goes before the new comes
    picture_ = gl::Texture(*api_, {.format = GL_RGBA16F, .width = width, .height = height}, "display values");
    picture_.parameter(GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    picture_.parameter(GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    framebuffer_.attach(GL_COLOR_ATTACHMENT0, picture_);
  }
  return {framebuffer_.name(), 0, 0, width, height};
}

void FxaaPass::run(const FrameView& view, const Target& target) {
  const bool depth = target.depth != DepthUse::none;
  gl::Program& program = programs_[depth];
  if (!program) program = draw_.program("passes/fxaa.frag", {}, depth);
  const auto section = view.profiler.section("composite");
  picture_.bind(UNIT_PICTURE);
  draw_.run(view, program, target);
}

}  // namespace halfsilver
