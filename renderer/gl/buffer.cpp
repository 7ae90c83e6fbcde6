#include <halfsilver/gl/buffer.h>

#include <string>
#include <utility>

#include <halfsilver/error.h>

namespace halfsilver::gl {
namespace {

constexpr GLint64 kTexelBytes = 16;

GLbitfield storageFlags(BufferUse use) {
  return use == BufferUse::readback
             ? GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT | GL_CLIENT_STORAGE_BIT
             : GL_DYNAMIC_STORAGE_BIT;
}

}  // namespace

Buffer::Buffer(const Api& api, std::size_t bytes, const char* label, BufferUse use) : api_(&api), bytes_(bytes) {
  if (bytes == 0) return;
  const GLint64 limit = use == BufferUse::texels ? api.limits.bufferTexels * kTexelBytes : api.limits.storageBlockBytes;
  if (use != BufferUse::readback && static_cast<GLint64>(bytes) > limit)
    throw Error(ErrorKind::failed, std::string("the ") + label + " buffer needs " + std::to_string(bytes >> 20) +
                                       " MiB, the device's limit for one buffer is " + std::to_string(limit >> 20) +
                                       " MiB");
  for (int i = 0; i < 16 && api.GetError() != GL_NO_ERROR; ++i) {  // a lost context has errors for ever
  }
  api.CreateBuffers(1, &name_);
  api.NamedBufferStorage(name_, static_cast<GLsizeiptr>(bytes), nullptr, storageFlags(use));
  if (api.GetError() == GL_OUT_OF_MEMORY) {
    api.DeleteBuffers(1, &name_);
    name_ = 0;
    throw Error(ErrorKind::failed, std::string("out of GPU memory: the ") + label + " buffer needs " +
                                       std::to_string(bytes >> 20) + " MiB");
  }
  api.ObjectLabel(GL_BUFFER, name_, -1, label);
  if (use != BufferUse::readback && bytes > api.largestBuffer->bytes) *api.largestBuffer = {bytes, label};
}

Buffer::~Buffer() {
  if (name_) api_->DeleteBuffers(1, &name_);
}

Buffer::Buffer(Buffer&& other) noexcept
    : api_(other.api_), name_(std::exchange(other.name_, 0)), bytes_(std::exchange(other.bytes_, 0)) {}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
  std::swap(api_, other.api_);
  std::swap(name_, other.name_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

void Buffer::write(std::size_t offset, const void* data, std::size_t bytes) {
  if (bytes) api_->NamedBufferSubData(name_, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), data);
}

void Buffer::fill(GLuint value) { fill(value, 0, bytes_); }

void Buffer::fill(GLuint value, std::size_t offset, std::size_t bytes) {
  if (bytes)
    api_->ClearNamedBufferSubData(name_, GL_R32UI, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes),
                                  GL_RED_INTEGER, GL_UNSIGNED_INT, &value);
}

void Buffer::read(std::size_t offset, void* data, std::size_t bytes) const {
  if (bytes) api_->GetNamedBufferSubData(name_, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), data);
}

void Buffer::bindStorage(GLuint binding) const { api_->BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name_); }
void Buffer::bindUniform(GLuint binding) const { api_->BindBufferBase(GL_UNIFORM_BUFFER, binding, name_); }

}  // namespace halfsilver::gl
