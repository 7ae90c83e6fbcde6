#include "passes/shade.h"

#include <vector>

#include "shared/passes/shade.h"
#include "shared/passes/shadow_marks.h"

namespace halfsilver {

ShadePass::ShadePass(const gl::Api& api) : api_(&api) {
  programs_[0][0][0][0] = gl::Program::compute(api, "passes/shade.comp");
}

void ShadePass::run(const FrameView& view, const GBuffer& gbuffer, int firstRow, int rows) {
  const bool marked = static_cast<bool>(gbuffer.shadowMarks);
  const bool coats = view.frame.coats != 0, glossy = static_cast<bool>(gbuffer.seen);
  gl::Program& program = programs_[marked][view.scene.lobes][coats][glossy];
  if (!program) {
    std::vector<gl::Define> defines;
    if (marked) defines.push_back({"SHADOW_MARKS"});
    if (view.scene.lobes) defines.push_back({"LOBES"});
    if (coats) defines.push_back({"COATS"});
    if (glossy) defines.push_back({"GLOSSY"});
    program = gl::Program::compute(*api_, "passes/shade.comp", defines);
  }
  const auto section = view.profiler.section("shade");
  program.use();
  program.set("firstRow", firstRow);
  program.set("rows", rows);
  if (marked) gbuffer.shadowMarks.bind(UNIT_SHADOW_MARKS);
  view.constants.bindUniform(UBO_FRAME);
  view.scene.bindTriangles();
  view.shadows.bind();
  view.scene.sky.bind(UNIT_SKY);
  gbuffer.bindSurface();
  if (glossy) {
    gbuffer.seen.bindImage(IMAGE_SEEN, GL_WRITE_ONLY);
    gbuffer.occlusion.bindImage(IMAGE_OCCLUSION, GL_WRITE_ONLY);
  }
  constexpr int kGroup = 8;
  api_->DispatchCompute(static_cast<GLuint>((gbuffer.width + kGroup - 1) / kGroup),
                        static_cast<GLuint>((rows + kGroup - 1) / kGroup), 1);
  // The shaded pixels (compute) are read by the composite pass and by read-backs, and added to by rays to lights;
  // traced light and what the screen has answered are stored over what this dispatch has.
  api_->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                      GL_TEXTURE_UPDATE_BARRIER_BIT);
}

}  // namespace halfsilver
