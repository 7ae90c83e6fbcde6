#pragma once

#include <optional>
#include <span>
#include <vector>

#include <halfsilver/frame_view.h>
#include "gl/program.h"

namespace halfsilver {

// Motion vectors: how far each pixel's surface has moved on the screen since the frame before. Keeps the camera and the
// positions of that frame, as long as frames ask for motion.
class MotionPass {
 public:
  explicit MotionPass(const gl::Api& api) : api_(&api) {}

  // Part of the section "gbuffer". Writes GBuffer::motion; 0 everywhere if there is no frame before to compare with.
  // `moved` are the vertices that moved since that one. Without `next` the moment of the last frame is drawn again: the
  // frame before stays the same.
  void run(const FrameView& view, std::vector<VertexRange> moved, bool next, GBuffer& gbuffer);
  // Before vertices move again: what the frame drew last is the frame before from now on.
  void advance(const GpuScene& scene);
  // The next frame has none before it.
  void forget();

  // SSBO_PREVIOUS_POSITIONS and UBO_PREVIOUS_FRAME, of the frame before the one that run() saw last.
  void bindPrevious() const;
  const gl::Buffer& previousPositions() const { return positions_; }
  std::size_t bytes() const { return positions_.bytes() + constants_.bytes(); }

 private:
  const gl::Api* api_;
  gl::Program program_;   // made when first used
  gl::Buffer positions_;  // of the frame before; empty if there is none
  gl::Buffer constants_;  // FrameConstants of the frame before
  // Of the frame that run() saw last, until advance().
  std::optional<shared::FrameConstants> frame_;
  std::vector<VertexRange> moved_;
};

}  // namespace halfsilver
