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

  // One more, which shares the program of this one.
  RayReader another() const { return RayReader(*api_, program_); }

  // Has the queue's count copied, and with it as many rays written as are likely to be there.
  void submit(const FrameView& view, const RayQueue& queue, std::uint32_t likely);
  // Whether rays() would not wait, but for rays beyond the likely ones. Never waits.
  bool ready() const { return countRead_.ready(); }
  // All rays of the queue. Waits; once more if there are more than was likely. Valid until the next submit().
  std::span<const shared::Ray> rays(const FrameView& view, const RayQueue& queue);

  std::size_t bytes() const { return buffer_.bytes() + countRead_.bytes(); }  // of mapped memory

 private:
  RayReader(const gl::Api& api, std::shared_ptr<const gl::Program> program);
  void write(const FrameView& view, const RayQueue& queue);

  const gl::Api* api_;
  std::shared_ptr<const gl::Program> program_;
  gl::Readback countRead_;
  gl::Readback::Slice<shared::RayCount> count_;
  gl::Buffer buffer_;
  const shared::Ray* memory_ = nullptr;
  std::uint32_t written_ = 0;
};

}  // namespace halfsilver
