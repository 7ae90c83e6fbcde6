#include "passes/composite.h"

#include <vector>

namespace halfsilver {
namespace {

gl::Program makeProgram(const gl::Api& api, bool linear) {
  std::vector<gl::Define> defines;
  if (linear) defines.push_back({"LINEAR"});
  return gl::Program::raster(api, "passes/fullscreen.vert", "passes/composite.frag", defines);
}

}  // namespace

CompositePass::CompositePass(const gl::Api& api)
    : api_(&api), display_(makeProgram(api, false)), linear_(makeProgram(api, true)), vertexArray_(api) {}

void CompositePass::run(const FrameView& view, const GBuffer& gbuffer, Output output, GLuint framebuffer,
                        const glm::ivec2& origin) const {
  const auto section = view.profiler.section("composite");
  view.constants.bindUniform(UBO_FRAME);
  view.scene.sky.bind(UNIT_SKY);
  gbuffer.position.bind(UNIT_POSITION);
  gbuffer.normal.bind(UNIT_NORMAL);
  gbuffer.material.bind(UNIT_MATERIAL);
  gbuffer.shaded.bind(UNIT_SHADED);
  gbuffer.reflection.bind(UNIT_REFLECTION);
  const gl::Program& program = output == Output::display ? display_ : linear_;
  program.set("origin", glm::vec2(origin));
  program.use();
  vertexArray_.bind();
  api_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  api_->Disable(GL_DEPTH_TEST);
  api_->Disable(GL_CULL_FACE);
  api_->Viewport(origin.x, origin.y, gbuffer.width, gbuffer.height);
  api_->DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace halfsilver
