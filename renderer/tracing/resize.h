#pragma once

#include <algorithm>
#include <glm/glm.hpp>

#include <halfsilver/gl/buffer.h>

namespace halfsilver {

// Makes a buffer of exactly that size, of undefined contents, unless it has it. Never empty: that could not be bound.
inline void resize(const gl::Api& api, gl::Buffer& buffer, std::size_t bytes, const char* label) {
  bytes = std::max<std::size_t>(bytes, sizeof(glm::uvec4));
  if (buffer.bytes() == bytes) return;
  buffer = gl::Buffer();  // the old one goes first: both at once might not fit
  buffer = gl::Buffer(api, bytes, label);
}

}  // namespace halfsilver
