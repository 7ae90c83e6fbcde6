#pragma once

#include <glm/glm.hpp>

#include <halfsilver/gl/api.h>

namespace halfsilver::gl {

// glEnable or glDisable.
inline void setEnabled(const Api& api, GLenum capability, bool on) {
  on ? api.Enable(capability) : api.Disable(capability);
}

// The whole fixed-function state of a pass's draws and clears, so that a pass never depends on what an earlier one has
// left behind and has nothing to put back. The defaults are those of a pass without depth, culling and blending:
//
//   gl::DrawState{.viewport = {0, 0, width, height}, .depthTest = true, .depthWrite = true}.apply(api);
//
// Program, framebuffer and vertex array are bound by the pass. What no pass changes (multisampling, dithering, clip
// distances, ...) keeps the initial value that StateGuard has set.
struct DrawState {
  glm::ivec4 viewport{0};  // x, y, width, height in pixels; of all viewports

  bool depthTest = false;  // without it depth is not written either
  GLenum depthFunction = GL_LESS;
  bool depthWrite = false;                    // also of clears
  GLenum clipDepth = GL_NEGATIVE_ONE_TO_ONE;  // of clip space; depth in windows is 0 to 1
  bool cullFaces = false;
  GLenum culledFace = GL_BACK;
  GLenum frontFace = GL_CCW;
  bool colorWrite = true;  // all channels of all draw buffers; also of clears

  // Also turns off: scissor and stencil test, blending, logic operations, polygon offset, depth clamp, conversion to
  // sRGB, rasterizer discard. Polygons are filled.
  void apply(const Api& api) const;
};

}  // namespace halfsilver::gl
