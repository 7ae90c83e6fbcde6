#include "passes/composite.h"

#include <vector>

#include "gl/draw_state.h"

namespace halfsilver {
namespace {

gl::Program makeProgram(const gl::Api& api, const char* define = nullptr) {
  std::vector<gl::Define> defines;
  if (define) defines.push_back({define});
  return gl::Program::raster(api, "passes/fullscreen.vert", "passes/composite.frag", defines);
}

}  // namespace

CompositePass::CompositePass(const gl::Api& api)
    : api_(&api), display_(makeProgram(api)), linear_(makeProgram(api, "LINEAR")), vertexArray_(api) {}

void CompositePass::run(const FrameView& view, const GBuffer& gbuffer, Output output, GLuint framebuffer,
                        const glm::ivec2& origin) {
  if (output == Output::undithered && !undithered_) undithered_ = makeProgram(*api_, "UNDITHERED");
  const auto section = view.profiler.section("composite");
  const gl::Program& program = output == Output::display ? display_ : output == Output::linear ? linear_ : undithered_;
  program.set("origin", glm::vec2(origin));
  program.use();
  view.constants.bindUniform(UBO_FRAME);
  gbuffer.shaded.bind(UNIT_SHADED);
  gbuffer.reflection.bind(UNIT_REFLECTION);
  view.scene.sky.bind(UNIT_SKY);
  gbuffer.position.bind(UNIT_POSITION);
  gbuffer.normal.bind(UNIT_NORMAL);
  gbuffer.material.bind(UNIT_MATERIAL);
  api_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  vertexArray_.bind();
  gl::DrawState{.viewport = {origin, gbuffer.width, gbuffer.height}}.apply(*api_);
  api_->DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace halfsilver
