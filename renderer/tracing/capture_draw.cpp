#include "tracing/capture_draw.h"

#include "gl/draw_state.h"
#include "shared/passes/gbuffer.h"

namespace halfsilver {

CaptureDraw::CaptureDraw(const gl::Api& api, const std::string& vertex, const std::string& fragment)
    : api_(&api), opaque_(gl::Program::raster(api, vertex, fragment)), framebuffer_(api), vertexArray_(api) {
  const gl::Define cut[] = {{"ALPHA_TEST"}};
  cut_ = gl::Program::raster(api, vertex, fragment, cut);
}

void CaptureDraw::run(const FrameView& view, const Into& into,
                      const std::function<void(const gl::Program&)>& prepare) const {
  const gl::Texture::Shape& shape = into.image.shape();
  if (shape.target == GL_TEXTURE_2D)
    framebuffer_.attach(GL_COLOR_ATTACHMENT0, into.image);
  else
    framebuffer_.attachLayer(GL_COLOR_ATTACHMENT0, into.image, into.layer);
  framebuffer_.attach(GL_DEPTH_ATTACHMENT, into.depth);
  framebuffer_.bind();
  vertexArray_.bind();
  view.constants.bindUniform(UBO_FRAME);
  view.scene.bindSurfaces();
  view.scene.drawList.bindStorage(SSBO_DRAW_LIST);
  // As the G-buffer is drawn.
  gl::DrawState state{.viewport = {0, 0, shape.width, shape.height},
                      .depthTest = true,
                      .depthFunction = GL_GREATER,
                      .depthWrite = true,
                      .clipDepth = GL_ZERO_TO_ONE,
                      .culledFace = static_cast<GLenum>(into.mirrored ? GL_FRONT : GL_BACK)};
  state.apply(*api_);
  const GLuint nothing[4] = {0, 0, 0, 0};
  const GLfloat farthest = 0;
  api_->ClearNamedFramebufferuiv(framebuffer_.name(), GL_COLOR, 0, nothing);
  api_->ClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &farthest);
  for (const DrawRange& range : view.scene.drawRanges) {
    const gl::Program& program = range.cut ? cut_ : opaque_;
    program.use();
    if (prepare) prepare(program);
    state.cullFaces = view.frame.cullBackFaces && !range.doubleSided;
    state.apply(*api_);
    api_->DrawArrays(GL_TRIANGLES, static_cast<GLint>(3 * range.first), static_cast<GLsizei>(3 * range.count));
  }
}

}  // namespace halfsilver
