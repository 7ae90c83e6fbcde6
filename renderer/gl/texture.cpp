#include <halfsilver/gl/texture.h>

#include <algorithm>
#include <string>
#include <utility>

#include <halfsilver/error.h>

namespace halfsilver::gl {
namespace {

std::size_t texelBytes(GLenum format) {
  switch (format) {
    case GL_R8:
    case GL_R8UI:
      return 1;
    case GL_RG8:
    case GL_R16F:
      return 2;
    case GL_RGBA16F:
    case GL_RG32UI:
    case GL_RG32F:
      return 8;
    case GL_RGBA32F:
    case GL_RGBA32UI:
      return 16;
    default:
      return 4;
  }
}

}  // namespace

Texture::Texture(const Api& api, const Shape& shape, const char* label) : api_(&api), shape_(shape) {
  for (int i = 0; i < 16 && api.GetError() != GL_NO_ERROR; ++i) {  // a lost context has errors for ever
  }
  api.CreateTextures(shape.target, 1, &name_);
  if (shape.target == GL_TEXTURE_2D)
    api.TextureStorage2D(name_, shape.levels, shape.format, shape.width, shape.height);
  else
    api.TextureStorage3D(name_, shape.levels, shape.format, shape.width, shape.height, shape.depth);
  if (const GLenum error = api.GetError(); error != GL_NO_ERROR) {
    api.DeleteTextures(1, &name_);
    name_ = 0;
    throw Error(ErrorKind::failed,
                std::string("the ") + label + " texture of " + std::to_string(shape.width) + " x " +
                    std::to_string(shape.height) + " x " + std::to_string(shape.depth) + " cannot be made: " +
                    (error == GL_OUT_OF_MEMORY ? "out of GPU memory" : "beyond the device's limits"));
  }
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) parameter(wrap, GL_CLAMP_TO_EDGE);
  parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  api.ObjectLabel(GL_TEXTURE, name_, -1, label);
}

Texture::~Texture() {
  if (name_) api_->DeleteTextures(1, &name_);
}

Texture::Texture(Texture&& other) noexcept
    : api_(other.api_), name_(std::exchange(other.name_, 0)), shape_(other.shape_) {}

Texture& Texture::operator=(Texture&& other) noexcept {
  std::swap(api_, other.api_);
  std::swap(name_, other.name_);
  std::swap(shape_, other.shape_);
  return *this;
}

std::size_t Texture::bytes() const {
  if (!name_) return 0;
  std::size_t total = 0;
  for (int level = 0; level < shape_.levels; ++level) {
    const auto scaled = [level](int n) { return static_cast<std::size_t>(std::max(1, n >> level)); };
    const std::size_t depth =
        shape_.target == GL_TEXTURE_3D ? scaled(shape_.depth) : static_cast<std::size_t>(shape_.depth);
    total += scaled(shape_.width) * scaled(shape_.height) * depth * texelBytes(shape_.format);
  }
  return total;
}

void Texture::bind(GLuint unit) const { api_->BindTextureUnit(unit, name_); }

void Texture::bindImage(GLuint unit, GLenum access, GLint level) const {
  api_->BindImageTexture(unit, name_, level, GL_TRUE, 0, access, shape_.format);
}

void Texture::parameter(GLenum name, GLint value) const { api_->TextureParameteri(name_, name, value); }

void Texture::read(GLenum format, GLenum type, std::size_t bytes, void* data) const {
  api_->GetTextureImage(name_, 0, format, type, static_cast<GLsizei>(bytes), data);
}

}  // namespace halfsilver::gl
