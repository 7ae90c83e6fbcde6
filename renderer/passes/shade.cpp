#include "passes/shade.h"

#include <vector>

#include "shared/passes/shade.h"
#include "shared/passes/shadow_marks.h"

namespace halfsilver {

ShadePass::ShadePass(const gl::Api& api) : api_(&api) {
  programs_[0][0][0] = gl::Program::compute(api, "passes/shade.comp");
}

void ShadePass::run(const FrameView& view, const GBuffer& gbuffer) {
  const bool marked = static_cast<bool>(gbuffer.shadowMarks);
  const bool coats = view.frame.coats != 0;
  gl::Program& program = programs_[marked][view.scene.lobes][coats];
  if (!program) {
    std::vector<gl::Define> defines;
    if (marked) defines.push_back({"SHADOW_MARKS"});
    if (view.scene.lobes) defines.push_back({"LOBES"});
    if (coats) defines.push_back({"COATS"});
    program = gl::Program::compute(*api_, "passes/shade.comp", defines);
  }
  const auto section = view.profiler.section("shade");
  api_->ClearTexImage(gbuffer.reflection.name(), 0, GL_RGBA, GL_FLOAT, nullptr);
  const GLfloat nobodyLooked[4] = {0, 0, 0, -1};
  if (gbuffer.seen) api_->ClearTexImage(gbuffer.seen.name(), 0, GL_RGBA, GL_FLOAT, nobodyLooked);
  program.use();
  if (marked) gbuffer.shadowMarks.bind(UNIT_SHADOW_MARKS);
  view.constants.bindUniform(UBO_FRAME);
  view.scene.bindTriangles();
  view.shadows.bind();
  view.scene.sky.bind(UNIT_SKY);
  gbuffer.bindSurface();
  gbuffer.shaded.bindImage(IMAGE_SHADED, GL_WRITE_ONLY);
  constexpr int kGroup = 8;
  api_->DispatchCompute(static_cast<GLuint>((gbuffer.width + kGroup - 1) / kGroup),
                        static_cast<GLuint>((gbuffer.height + kGroup - 1) / kGroup), 1);
  // The shaded pixels (compute) are read by the composite pass and by read-backs, and added to by rays to lights.
  api_->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                      GL_TEXTURE_UPDATE_BARRIER_BIT);
}

}  // namespace halfsilver
