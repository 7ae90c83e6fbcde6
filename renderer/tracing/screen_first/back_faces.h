#pragma once

#include <cstdint>

#include <halfsilver/frame_view.h>
#include "gl/framebuffer.h"
#include "gl/program.h"

namespace halfsilver {

// Where the camera looks through the backs of single-sided materials: these are invisible to it, but a ray that comes
// from the other side meets their fronts before what is seen. Holes count as surface.
class BackFaces {
 public:
  explicit BackFaces(const gl::Api& api);

  // The nearest depths of the view, as GBuffer::depth, if such backs are drawn as well; null if the scene has none.
  const gl::Texture* draw(const FrameView& view);

  std::uint64_t bytes() const { return depth_.bytes(); }

 private:
  const gl::Api* api_;
  gl::Program program_;
  gl::Framebuffer framebuffer_;
  gl::EmptyVertexArray vertexArray_;
  gl::Texture depth_;
};

}  // namespace halfsilver
