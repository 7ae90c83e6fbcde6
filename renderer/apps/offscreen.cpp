#include "apps/offscreen.h"

#include <algorithm>
#include <string>

#include <halfsilver/error.h>

namespace halfsilver {

OffscreenTarget::OffscreenTarget(const gl::Api& api, const Size& size) : size_(size) {
  const int limit = std::min(api.limits.textureSize, api.limits.framebufferSize);
  if (std::max(size.width, size.height) > limit)
    throw Error(ErrorKind::noContext, "this device draws at most " + std::to_string(limit) +
                                          " pixels along an edge, but --size asks for " + std::to_string(size.width) +
                                          "x" + std::to_string(size.height));
  gl::Texture::Shape shape;
  shape.width = size.width;
  shape.height = size.height;
  color_ = gl::Texture(api, shape, "picture");
  framebuffer_ = gl::Framebuffer(api);
  framebuffer_.attach(GL_COLOR_ATTACHMENT0, color_);
}

Target OffscreenTarget::target() const { return {framebuffer_.name(), 0, 0, size_.width, size_.height}; }

std::vector<std::uint8_t> OffscreenTarget::read() const {
  const std::size_t row = static_cast<std::size_t>(size_.width) * 4;
  std::vector<std::uint8_t> pixels(row * static_cast<std::size_t>(size_.height));
  color_.read(GL_RGBA, GL_UNSIGNED_BYTE, pixels.size(), pixels.data());
  for (auto top = pixels.begin(), bottom = pixels.end(); bottom - top >= static_cast<std::ptrdiff_t>(2 * row);) {
    bottom -= static_cast<std::ptrdiff_t>(row);
    std::swap_ranges(top, top + static_cast<std::ptrdiff_t>(row), bottom);
    top += static_cast<std::ptrdiff_t>(row);
  }
  return pixels;
}

}  // namespace halfsilver
