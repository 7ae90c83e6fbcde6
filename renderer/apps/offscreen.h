#pragma once

#include <cstdint>
#include <vector>

#include <halfsilver/gl/texture.h>
#include <halfsilver/renderer.h>
#include "apps/arguments.h"
#include "gl/framebuffer.h"

namespace halfsilver {

// An RGBA8 framebuffer to draw into: contexts without a window have none.
class OffscreenTarget {
 public:
  // Throws Error (noContext) if the size is above the device's limit.
  OffscreenTarget(const gl::Api& api, const Size& size);

  Target target() const;
  unsigned texture() const { return color_.name(); }
  // 8-bit RGBA, rows from the top. Waits for the GPU.
  std::vector<std::uint8_t> read() const;

 private:
  Size size_;
  gl::Texture color_;
  gl::Framebuffer framebuffer_;
};

}  // namespace halfsilver
