#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include <halfsilver/frame_view.h>
#include <halfsilver/gl/readback.h>

namespace halfsilver {

namespace gl {
class Program;
}

// The rays of a queue for the host: the GPU writes them whole into mapped memory, however the queue stores them, so
// that the host sees the bits that shaders see. Move-only.
class RayReader {
 public:
  explicit RayReader(const gl::Api& api);
  ~RayReader();
  RayReader(RayReader&&) noexcept;
  RayReader& operator=(RayReader&&) noexcept;

  // Has the first `count` rays written, at most as many as the queue holds, and forgets those before.
  void submit(const FrameView& view, const RayQueue& rays, std::uint32_t count);
  // Whether rays() would not wait. Never waits.
  bool ready() const { return count_ == 0 || fence_.signaled(); }
  // Waits for what submit() asked for. Valid until the next one.
  std::span<const shared::Ray> rays() const;

  std::size_t bytes() const { return buffer_.bytes(); }  // of mapped memory

 private:
  const gl::Api* api_;
  std::unique_ptr<gl::Program> program_;
  gl::Buffer buffer_;
  const shared::Ray* memory_ = nullptr;
  std::uint32_t count_ = 0;
  gl::Fence fence_;
};

}  // namespace halfsilver
