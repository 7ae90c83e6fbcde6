#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include <halfsilver/error.h>
#include <halfsilver/gl/buffer.h>

namespace halfsilver::gl {

struct TexelFormat {
  GLenum format;
  std::size_t bytes;  // of a texel
};
inline constexpr TexelFormat kFloatTexels{GL_RGBA32F, 16}, kWordTexels{GL_R32UI, 4};

// A buffer seen as texels: its limit is that of buffer textures, far above a storage block's. Software rasterizers read
// a storage buffer number by number, a texel in one go. Move-only.
class TexelBuffer {
 public:
  TexelBuffer() = default;
  // `data`: the texels, or null.
  TexelBuffer(const Api& api, std::size_t texels, const char* label, const void* data = nullptr,
              const TexelFormat& format = kFloatTexels)
      : api_(&api), format_(format.format) {
    if (texels > static_cast<std::size_t>(api.limits.bufferTexels))
      throw Error(ErrorKind::failed, std::string("the ") + label + " buffer needs " + std::to_string(texels) +
                                         " texels, the device's limit is " + std::to_string(api.limits.bufferTexels));
    buffer_ = Buffer(api, texels * format.bytes, label, BufferUse::texels);
    if (data) buffer_.write(0, data, texels * format.bytes);
    api.CreateTextures(GL_TEXTURE_BUFFER, 1, &view_);
    api.TextureBuffer(view_, format_, buffer_.name());
  }
  ~TexelBuffer() {
    if (view_) api_->DeleteTextures(1, &view_);
  }
  TexelBuffer(TexelBuffer&& other) noexcept
      : api_(other.api_),
        format_(other.format_),
        buffer_(std::move(other.buffer_)),
        view_(std::exchange(other.view_, 0)) {}
  TexelBuffer& operator=(TexelBuffer&& other) noexcept {
    std::swap(api_, other.api_);
    std::swap(format_, other.format_);
    std::swap(buffer_, other.buffer_);
    std::swap(view_, other.view_);
    return *this;
  }
  TexelBuffer(const TexelBuffer&) = delete;
  TexelBuffer& operator=(const TexelBuffer&) = delete;

  std::size_t bytes() const { return buffer_.bytes(); }
  void bind(GLuint unit) const { api_->BindTextureUnit(unit, view_); }
  void bindImage(GLuint unit, GLenum access) const {
    api_->BindImageTexture(unit, view_, 0, GL_FALSE, 0, access, format_);
  }

 private:
  const Api* api_ = nullptr;
  GLenum format_ = GL_NONE;
  Buffer buffer_;
  GLuint view_ = 0;
};

// Texels with the values, whole texels each, as contents; one value of zeros if there are none.
template <class T>
TexelBuffer makeTexelBuffer(const Api& api, std::span<const T> values, const char* label,
                            const TexelFormat& format = kFloatTexels) {
  const T none{};
  const std::span<const T> contents = values.empty() ? std::span<const T>(&none, 1) : values;
  return TexelBuffer(api, contents.size_bytes() / format.bytes, label, contents.data(), format);
}

}  // namespace halfsilver::gl
