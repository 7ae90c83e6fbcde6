#include "passes/shadow_marks.h"

#include <algorithm>
#include <vector>

#include "shared/passes/shadow_marks.h"

namespace halfsilver {
namespace {

constexpr int kTile = 8;

gl::Texture::Shape shapeFor(const FrameView& view) {
  const int layers = static_cast<int>((view.frame.directLights + LIGHTS_PER_MARK - 1) / LIGHTS_PER_MARK);
  return {.target = GL_TEXTURE_2D_ARRAY,
          .format = GL_RG32UI,
          .width = view.gbuffer.width,
          .height = view.gbuffer.height,
          .depth = std::max(1, layers)};
}

void fit(const gl::Api& api, const gl::Texture::Shape& shape, const char* label, gl::Texture& texture) {
  const gl::Texture::Shape& present = texture.shape();
  if (texture && present.width == shape.width && present.height == shape.height && present.depth == shape.depth) return;
  texture = gl::Texture();  // the old memory goes before the new comes
  texture = gl::Texture(api, shape, label);
}

}  // namespace

void ShadowMarkPass::run(const FrameView& view, int kernel, GBuffer& gbuffer) {
  gl::Program& test = test_[view.frame.coats != 0];
  if (!test) {
    std::vector<gl::Define> defines;
    if (view.frame.coats != 0) defines.push_back({"COATS"});
    test = gl::Program::compute(*api_, "passes/shadow_test.comp", defines);
  }
  if (!spread_) spread_ = gl::Program::compute(*api_, "passes/spread_marks.comp");
  const gl::Texture::Shape shape = shapeFor(view);
  fit(*api_, shape, "shadow marks", gbuffer.shadowMarks);
  fit(*api_, shape, "shadow marks, on their way", scratch_);
  const auto section = view.profiler.section("shade");
  test.use();
  view.constants.bindUniform(UBO_FRAME);
  view.scene.bindTriangles();
  view.shadows.bind();
  gbuffer.bindSurface();
  gbuffer.shadowMarks.bindImage(IMAGE_SHADOW_MARKS, GL_WRITE_ONLY);
  dispatch(gbuffer.shadowMarks);
  spread(view, gbuffer.shadowMarks, scratch_, kernel / 2, false);
  spread(view, scratch_, gbuffer.shadowMarks, kernel / 2, true);
}

void ShadowMarkPass::spread(const FrameView& view, const gl::Texture& from, const gl::Texture& to, int reach,
                            bool upward) const {
  spread_.use();
  spread_.set("reach", reach);
  spread_.set("upward", upward ? 1u : 0u);
  view.constants.bindUniform(UBO_FRAME);
  from.bind(UNIT_SHADOW_MARKS);
  to.bindImage(IMAGE_SHADOW_MARKS, GL_WRITE_ONLY);
  dispatch(to);
}

void ShadowMarkPass::dispatch(const gl::Texture& marks) const {
  const gl::Texture::Shape& shape = marks.shape();
  api_->DispatchCompute(static_cast<GLuint>((shape.width + kTile - 1) / kTile),
                        static_cast<GLuint>((shape.height + kTile - 1) / kTile), static_cast<GLuint>(shape.depth));
  // This dispatch writes marks; the next one, the shading and rays to lights fetch them, the layers read them back.
  // It loads base color and emission, over which the shading stores.
  api_->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                      GL_TEXTURE_UPDATE_BARRIER_BIT);
}

}  // namespace halfsilver
