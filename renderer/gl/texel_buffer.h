#pragma once

#include <utility>

#include <halfsilver/gl/buffer.h>

namespace halfsilver::gl {

// A buffer seen as an image of RGBA32F texels: its limit is that of buffer textures, far above a storage block's.
// Move-only.
class TexelBuffer {
 public:
  TexelBuffer() = default;
  TexelBuffer(const Api& api, std::size_t texels, const char* label)
      : api_(&api), buffer_(api, texels * 16, label, BufferUse::texels) {
    api.CreateTextures(GL_TEXTURE_BUFFER, 1, &view_);
    api.TextureBuffer(view_, GL_RGBA32F, buffer_.name());
  }
  ~TexelBuffer() {
    if (view_) api_->DeleteTextures(1, &view_);
  }
  TexelBuffer(TexelBuffer&& other) noexcept
      : api_(other.api_), buffer_(std::move(other.buffer_)), view_(std::exchange(other.view_, 0)) {}
  TexelBuffer& operator=(TexelBuffer&& other) noexcept {
    std::swap(api_, other.api_);
    std::swap(buffer_, other.buffer_);
    std::swap(view_, other.view_);
    return *this;
  }
  TexelBuffer(const TexelBuffer&) = delete;
  TexelBuffer& operator=(const TexelBuffer&) = delete;

  std::size_t bytes() const { return buffer_.bytes(); }
  void bindImage(GLuint unit, GLenum access) const {
    api_->BindImageTexture(unit, view_, 0, GL_FALSE, 0, access, GL_RGBA32F);
  }

 private:
  const Api* api_ = nullptr;
  Buffer buffer_;
  GLuint view_ = 0;
};

}  // namespace halfsilver::gl
