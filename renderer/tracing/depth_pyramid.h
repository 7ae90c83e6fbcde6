#pragma once

#include <cstdint>
#include <optional>

#include <halfsilver/frame_view.h>
#include "gl/program.h"
#include "tracing/per_frame.h"

namespace halfsilver {

// The nearest depths of what a frame shows, in cells of 1, 2, 4, ... 32 pixels: rays go over the screen in large steps
// where they stay before all of it. One per frame under way. See shaders/tracing/common/pyramid.comp.
class DepthPyramid {
 public:
  explicit DepthPyramid(const gl::Api& api);

  // Of the view's G-buffer. `backs`: what lies nearest if backs of single-sided materials count, too (as
  // GBuffer::depth); cells that such a back may decide have negative depths. Null: they do not count.
  void build(const FrameView& view, const gl::Texture* backs = nullptr);

  // Whether the pyramid of the view's G-buffer is that of a frame with equal constants, since the last forget().
  bool holds(const FrameView& view) const;
  // What is seen may have changed.
  void forget();

  // UNIT_SCREEN_DEPTHS: the pyramid of the view's G-buffer.
  void bind(const FrameView& view) const;

  std::uint64_t bytes() const;

 private:
  struct OfFrame {
    std::optional<shared::FrameConstants> built;  // for these
    gl::Texture depths;  // R32F, meters along the view axis; sides are multiples of the largest cell
  };

  const gl::Api* api_;
  gl::Program program_;
  PerFrame<OfFrame> frames_;
};

}  // namespace halfsilver
