#pragma once

#include <utility>

#include <halfsilver/gl/texture.h>

namespace halfsilver::gl {

// A framebuffer object; attachments are not owned. Move-only.
class Framebuffer {
 public:
  Framebuffer() = default;
  explicit Framebuffer(const Api& api) : api_(&api) { api.CreateFramebuffers(1, &name_); }
  // Without attachments: fragments run at this size and write only through images and buffers.
  Framebuffer(const Api& api, int width, int height) : Framebuffer(api) {
    api.NamedFramebufferParameteri(name_, GL_FRAMEBUFFER_DEFAULT_WIDTH, width);
    api.NamedFramebufferParameteri(name_, GL_FRAMEBUFFER_DEFAULT_HEIGHT, height);
  }
  ~Framebuffer() {
    if (name_) api_->DeleteFramebuffers(1, &name_);
  }
  Framebuffer(Framebuffer&& other) noexcept : api_(other.api_), name_(std::exchange(other.name_, 0)) {}
  Framebuffer& operator=(Framebuffer&& other) noexcept {
    std::swap(api_, other.api_);
    std::swap(name_, other.name_);
    return *this;
  }
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;

  GLuint name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }
  void attach(GLenum point, const Texture& texture) const {
    api_->NamedFramebufferTexture(name_, point, texture.name(), 0);
  }
  void attachLayer(GLenum point, const Texture& texture, int layer) const {
    api_->NamedFramebufferTextureLayer(name_, point, texture.name(), 0, layer);
  }
  void bind() const { api_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, name_); }

 private:
  const Api* api_ = nullptr;
  GLuint name_ = 0;
};

// A vertex array without attributes: vertices are pulled from storage buffers.
class EmptyVertexArray {
 public:
  EmptyVertexArray() = default;
  explicit EmptyVertexArray(const Api& api) : api_(&api) { api.CreateVertexArrays(1, &name_); }
  ~EmptyVertexArray() {
    if (name_) api_->DeleteVertexArrays(1, &name_);
  }
  EmptyVertexArray(EmptyVertexArray&& other) noexcept : api_(other.api_), name_(std::exchange(other.name_, 0)) {}
  EmptyVertexArray& operator=(EmptyVertexArray&& other) noexcept {
    std::swap(api_, other.api_);
    std::swap(name_, other.name_);
    return *this;
  }
  EmptyVertexArray(const EmptyVertexArray&) = delete;
  EmptyVertexArray& operator=(const EmptyVertexArray&) = delete;
  void bind() const { api_->BindVertexArray(name_); }

 private:
  const Api* api_ = nullptr;
  GLuint name_ = 0;
};

}  // namespace halfsilver::gl
