#pragma once

#include <functional>
#include <string>

#include <halfsilver/frame_view.h>
#include "gl/framebuffer.h"
#include "gl/program.h"

namespace halfsilver {

// Draws which triangle each pixel of an image sees from somewhere else than the camera: R32UI, triangle + 1 or 0.
class CaptureDraw {
 public:
  // Files below shaders/; the fragment shader is compiled with ALPHA_TEST as well.
  CaptureDraw(const gl::Api& api, const std::string& vertex, const std::string& fragment);

  struct Into {
    const gl::Texture& image;
    const gl::Texture& depth;  // of the same size
    int layer = 0;             // of the image
    bool mirrored = false;     // the vertex shader turns triangles the other way round
  };
  // `prepare` sets the uniforms of both programs.
  void run(const FrameView& view, const Into& into, const std::function<void(const gl::Program&)>& prepare = {}) const;

 private:
  const gl::Api* api_;
  gl::Program opaque_, cut_;
  gl::Framebuffer framebuffer_;
  gl::EmptyVertexArray vertexArray_;
};

}  // namespace halfsilver
