#pragma once

#include <halfsilver/frame_view.h>
#include "gl/program.h"

namespace halfsilver {

// Where shadow maps are in doubt (shadow.method = refined), after Beck et al. 2005, section 3.4, passes 2 and 3: the
// maps' answers of all pixels to all direct lights, and a kernel over them. Section "shade".
class ShadowMarkPass {
 public:
  explicit ShadowMarkPass(const gl::Api& api) : api_(&api) {}

  // Writes GBuffer::shadowMarks. `kernel`: pixels along a side of the square; an even one counts as the next odd one.
  void run(const FrameView& view, int kernel, GBuffer& gbuffer);

  std::size_t bytes() const { return scratch_.bytes(); }

 private:
  void spread(const FrameView& view, const gl::Texture& from, const gl::Texture& to, int reach, bool upward) const;
  void dispatch(const gl::Texture& marks) const;

  const gl::Api* api_;
  gl::Program test_[2], spread_;  // [with coats], made on first use
  gl::Texture scratch_;           // takes turns with GBuffer::shadowMarks
};

}  // namespace halfsilver
