#pragma once

#include <cstddef>

#include <halfsilver/gl/api.h>

namespace halfsilver::gl {

// A texture with immutable storage (2D, 2D array or 3D). Move-only; owns its GL name.
class Texture {
 public:
  struct Shape {
    GLenum target = GL_TEXTURE_2D;  // GL_TEXTURE_2D, GL_TEXTURE_2D_ARRAY, GL_TEXTURE_3D
    GLenum format = GL_RGBA8;       // sized internal format
    int width = 1;
    int height = 1;
    int depth = 1;  // layers or slices
    int levels = 1;
  };

  Texture() = default;
  // Nearest filtering and clamped edges until set otherwise. Throws Error (failed) when out of memory.
  Texture(const Api& api, const Shape& shape, const char* label);
  ~Texture();
  Texture(Texture&& other) noexcept;
  Texture& operator=(Texture&& other) noexcept;
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  GLuint name() const { return name_; }
  const Shape& shape() const { return shape_; }
  std::size_t bytes() const;  // of all levels
  explicit operator bool() const { return name_ != 0; }

  void bind(GLuint unit) const;
  void bindImage(GLuint unit, GLenum access, GLint level = 0) const;  // all layers
  void parameter(GLenum name, GLint value) const;
  // Reads level 0; the destination holds at least `bytes`. Waits for the GPU.
  void read(GLenum format, GLenum type, std::size_t bytes, void* data) const;

 private:
  const Api* api_ = nullptr;
  GLuint name_ = 0;
  Shape shape_;
};

}  // namespace halfsilver::gl
