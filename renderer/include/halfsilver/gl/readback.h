#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include <halfsilver/gl/buffer.h>

// Contents of GPU buffers for the host, copied into mapped memory by the GPU itself, so that the host can look whether
// they have arrived without waiting for them.
//
// Barriers: a copy reads its source in the order of GL's commands, except for what shaders wrote: that needs a
// GL_BUFFER_UPDATE_BARRIER_BIT barrier before the copy. GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT is not needed, since only
// copies write the mapped memory, which is coherent.
namespace halfsilver::gl {

// Signaled once the GPU has completed all commands before it. Move-only.
class Fence {
 public:
  Fence() = default;
  // Flushes, so that the commands before it do complete.
  explicit Fence(const Api& api);
  ~Fence();
  Fence(Fence&& other) noexcept;
  Fence& operator=(Fence&& other) noexcept;
  Fence(const Fence&) = delete;
  Fence& operator=(const Fence&) = delete;

  explicit operator bool() const { return sync_ != nullptr; }
  bool signaled() const;  // never waits
  // Adds one to Api::hostWaits, also if it is signaled already. Throws Error (failed) if the driver reports a failure.
  void wait() const;

 private:
  const Api* api_ = nullptr;
  GLsync sync_ = nullptr;
};

// Many small copies with one fence behind them: copy() during a frame, submit() at its end, values() in a later one.
// Move-only.
class Readback {
 public:
  // Where copied values will be, until clear().
  template <class T>
  struct Slice {
    std::size_t block = 0, offset = 0, count = 0;  // offset in bytes, count in elements
  };

  Readback() = default;
  explicit Readback(const Api& api) : api_(&api) {}

  // Has the GPU copy `count` elements of the source, which may change or go afterwards. Only before submit().
  template <class T>
  Slice<T> copy(const Buffer& source, std::size_t count = 1, std::size_t firstElement = 0) {
    static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= kAlignment);
    const Place place = copyBytes(source, firstElement * sizeof(T), count * sizeof(T));
    return {place.block, place.offset, count};
  }

  // Ends the copies with a fence.
  void submit();
  // Whether values() may be called. Never waits.
  bool ready() const { return fence_ && fence_.signaled(); }
  // Returns once ready(). Only after submit(). A host wait, as every Fence::wait().
  void wait() const;

  // Valid until clear() and no longer than this object. Only while ready().
  template <class T>
  std::span<const T> values(const Slice<T>& slice) const {
    if (slice.count == 0) return {};
    return {reinterpret_cast<const T*>(blocks_[slice.block].memory + slice.offset), slice.count};
  }

  // Forgets the copies, which need not have arrived, and keeps the memory for the next ones.
  void clear();

  std::size_t bytes() const;  // of mapped memory

 private:
  static constexpr std::size_t kAlignment = 16;

  struct Block {
    Buffer buffer;
    const std::byte* memory = nullptr;
  };
  struct Place {
    std::size_t block, offset;
  };
  Place copyBytes(const Buffer& source, std::size_t offset, std::size_t bytes);

  const Api* api_ = nullptr;
  std::vector<Block> blocks_;
  std::size_t block_ = 0, used_ = 0;  // the block that is being filled, bytes used in it
  Fence fence_;
};

// Reads a few values in the middle of a frame, for a decision that the host has to make before it goes on. Each read
// flushes and is a host wait. Move-only.
class BlockingRead {
 public:
  BlockingRead() = default;
  explicit BlockingRead(const Api& api) : readback_(api) {}

  template <class T>
  T read(const Buffer& source, std::size_t element = 0) {
    readback_.clear();
    const Readback::Slice<T> slice = readback_.copy<T>(source, 1, element);
    readback_.submit();
    readback_.wait();
    return readback_.values(slice)[0];
  }

 private:
  Readback readback_;
};

}  // namespace halfsilver::gl
