#pragma once

#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include <halfsilver/gl/api.h>

namespace halfsilver::gl {

enum class BufferUse {
  storage,  // bound as a shader storage block
  texels,   // read and written through a buffer texture of 16-byte texels
  readback  // written by copies, read by the host through mapped memory (see gl/readback.h)
};

// A GPU buffer of fixed size. Move-only; owns its GL name. An empty buffer (size 0) owns nothing.
class Buffer {
 public:
  Buffer() = default;
  // Uninitialized contents. Throws Error (failed) if the size is beyond the device's limit for the use or the
  // driver has no memory left; `label` names the buffer in messages and debuggers.
  Buffer(const Api& api, std::size_t bytes, const char* label, BufferUse use = BufferUse::storage);
  ~Buffer();
  Buffer(Buffer&& other) noexcept;
  Buffer& operator=(Buffer&& other) noexcept;
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  GLuint name() const { return name_; }
  std::size_t bytes() const { return bytes_; }
  explicit operator bool() const { return name_ != 0; }

  void write(std::size_t offset, const void* data, std::size_t bytes);
  template <class T>
  void write(std::span<const T> values, std::size_t firstElement = 0) {
    static_assert(std::is_trivially_copyable_v<T>);
    write(firstElement * sizeof(T), values.data(), values.size_bytes());
  }
  // Fills with one 32-bit value.
  void fill(GLuint value);
  void fill(GLuint value, std::size_t offset, std::size_t bytes);

  // Waits for the GPU. Shader writes must have been ordered by a GL_BUFFER_UPDATE_BARRIER_BIT barrier.
  void read(std::size_t offset, void* data, std::size_t bytes) const;
  template <class T>
  std::vector<T> read(std::size_t count, std::size_t firstElement = 0) const {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> values(count);
    if (count) read(firstElement * sizeof(T), values.data(), count * sizeof(T));
    return values;
  }

  void bindStorage(GLuint binding) const;  // GL_SHADER_STORAGE_BUFFER
  void bindUniform(GLuint binding) const;  // GL_UNIFORM_BUFFER

 private:
  const Api* api_ = nullptr;
  GLuint name_ = 0;
  std::size_t bytes_ = 0;
};

// A buffer with the values as contents; one element of zeros if there are none, so that it can be bound.
template <class T>
Buffer makeBuffer(const Api& api, std::span<const T> values, const char* label) {
  Buffer buffer(api, values.empty() ? sizeof(T) : values.size_bytes(), label);
  if (values.empty())
    buffer.fill(0);
  else
    buffer.write(values);
  return buffer;
}

}  // namespace halfsilver::gl
