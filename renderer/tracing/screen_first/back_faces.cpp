#include "tracing/screen_first/back_faces.h"

#include <algorithm>

#include "gl/draw_state.h"
#include "shared/passes/gbuffer.h"

namespace halfsilver {

BackFaces::BackFaces(const gl::Api& api)
    : api_(&api),
      program_(gl::Program::raster(api, "passes/visibility.vert", "passes/visibility.frag")),
      framebuffer_(api),
      vertexArray_(api) {}

const gl::Texture* BackFaces::draw(const FrameView& view) {
  const auto& ranges = view.scene.drawRanges;
  if (!view.frame.cullBackFaces ||
      std::none_of(ranges.begin(), ranges.end(), [](const DrawRange& range) { return !range.doubleSided; }))
    return nullptr;
  const gl::Texture& seen = view.gbuffer.depth;
  const gl::Texture::Shape &wanted = seen.shape(), &shape = depth_.shape();
  if (!depth_ || shape.width != wanted.width || shape.height != wanted.height) {
    depth_ = gl::Texture();  // the old memory goes before the new comes
    depth_ = gl::Texture(*api_, wanted, "depth with backs");
  }
  // Most backs are hidden by what is seen.
  api_->CopyImageSubData(seen.name(), GL_TEXTURE_2D, 0, 0, 0, 0, depth_.name(), GL_TEXTURE_2D, 0, 0, 0, 0, wanted.width,
                         wanted.height, 1);
  framebuffer_.attach(GL_DEPTH_ATTACHMENT, depth_);
  framebuffer_.bind();
  vertexArray_.bind();
  view.constants.bindUniform(UBO_FRAME);
  view.scene.bindTriangles();
  view.scene.drawList.bindStorage(SSBO_DRAW_LIST);
  gl::DrawState{.viewport = {0, 0, wanted.width, wanted.height},
                .depthTest = true,
                .depthFunction = GL_GREATER,
                .depthWrite = true,
                .clipDepth = GL_ZERO_TO_ONE,
                .cullFaces = true,
                .culledFace = GL_FRONT,
                .colorWrite = false}
      .apply(*api_);
  program_.use();
  for (const DrawRange& range : ranges)
    if (!range.doubleSided)
      api_->DrawArrays(GL_TRIANGLES, static_cast<GLint>(3 * range.first), static_cast<GLsizei>(3 * range.count));
  return &depth_;
}

}  // namespace halfsilver
