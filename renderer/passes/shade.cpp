#include "passes/shade.h"

#include "shared/passes/shade.h"
#include "shared/passes/shadow_marks.h"

namespace halfsilver {

ShadePass::ShadePass(const gl::Api& api) : api_(&api), program_(gl::Program::compute(api, "passes/shade.comp")) {}

void ShadePass::run(const FrameView& view, const GBuffer& gbuffer) {
  const bool marked = static_cast<bool>(gbuffer.shadowMarks);
  if (marked && !marked_) {
    const gl::Define defines[] = {{"SHADOW_MARKS"}};
    marked_ = gl::Program::compute(*api_, "passes/shade.comp", defines);
  }
  const auto section = view.profiler.section("shade");
  api_->ClearTexImage(gbuffer.reflection.name(), 0, GL_RGBA, GL_FLOAT, nullptr);
  (marked ? marked_ : program_).use();
  if (marked) gbuffer.shadowMarks.bind(UNIT_SHADOW_MARKS);
  view.constants.bindUniform(UBO_FRAME);
  view.scene.bindTriangles();
  view.shadows.bind();
  view.scene.sky.bind(UNIT_SKY);
  gbuffer.position.bind(UNIT_POSITION);
  gbuffer.normal.bind(UNIT_NORMAL);
  gbuffer.baseColor.bind(UNIT_BASE_COLOR);
  gbuffer.material.bind(UNIT_MATERIAL);
  gbuffer.emissive.bind(UNIT_EMISSIVE);
  gbuffer.visibility.bind(UNIT_VISIBILITY);
  gbuffer.shaded.bindImage(IMAGE_SHADED, GL_WRITE_ONLY);
  constexpr int kGroup = 8;
  api_->DispatchCompute(static_cast<GLuint>((gbuffer.width + kGroup - 1) / kGroup),
                        static_cast<GLuint>((gbuffer.height + kGroup - 1) / kGroup), 1);
  // The shaded pixels (compute) are read by the composite pass and by read-backs, and added to by rays to lights.
  api_->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                      GL_TEXTURE_UPDATE_BARRIER_BIT);
}

}  // namespace halfsilver
