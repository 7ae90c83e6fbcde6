#include "gl/draw_state.h"

namespace halfsilver::gl {

void DrawState::apply(const Api& api) const {
  api.Viewport(viewport.x, viewport.y, viewport.z, viewport.w);
  setEnabled(api, GL_DEPTH_TEST, depthTest);
  api.DepthFunc(depthFunction);
  api.DepthMask(depthWrite);
  api.DepthRange(0, 1);
  api.ClipControl(GL_LOWER_LEFT, clipDepth);
  setEnabled(api, GL_CULL_FACE, cullFaces);
  api.CullFace(culledFace);
  api.FrontFace(frontFace);
  api.ColorMask(colorWrite, colorWrite, colorWrite, colorWrite);
  api.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  for (const GLenum capability : {GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_BLEND, GL_COLOR_LOGIC_OP, GL_POLYGON_OFFSET_FILL,
                                  GL_DEPTH_CLAMP, GL_FRAMEBUFFER_SRGB, GL_RASTERIZER_DISCARD})
    api.Disable(capability);
}

}  // namespace halfsilver::gl
