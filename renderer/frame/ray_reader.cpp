#include <halfsilver/ray_reader.h>

#include <algorithm>
#include <utility>

#include <halfsilver/error.h>
#include "gl/program.h"
#include "shared/passes/read_rays.h"

namespace halfsilver {
namespace {

constexpr std::uint32_t kGroup = 64, kMaxGroups = 65535;

// Rays of one dispatch: they fill no more than a storage block, from places that any device takes as its beginning.
std::uint32_t maxRaysOf(const gl::Api& api) {
  const auto inBlock = static_cast<std::uint64_t>(api.limits.storageBlockBytes) / sizeof(shared::Ray);
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(inBlock / kGroup, kMaxGroups)) * kGroup;
}

}  // namespace

RayReader::RayReader(const gl::Api& api)
    : RayReader(api, std::make_shared<const gl::Program>(gl::Program::compute(api, "passes/read_rays.comp"))) {}
RayReader::RayReader(const gl::Api& api, std::shared_ptr<const gl::Program> program)
    : api_(&api), program_(std::move(program)), countRead_(api) {}
RayReader::~RayReader() = default;
RayReader::RayReader(RayReader&&) noexcept = default;
RayReader& RayReader::operator=(RayReader&&) noexcept = default;

void RayReader::submit(const FrameView& view, const RayQueue& queue, std::uint32_t likely) {
  written_ = std::min(likely, queue.capacity);
  countRead_.clear();
  write(view, queue);
  count_ = countRead_.copy<shared::RayCount>(queue.count);
  countRead_.submit();
}

std::span<const shared::Ray> RayReader::rays(const FrameView& view, const RayQueue& queue) {
  countRead_.wait();
  const std::uint32_t count = countRead_.values(count_)[0].count;
  if (count > written_) {
    submit(view, queue, count);
    countRead_.wait();
  }
  return {memory_, count};
}

void RayReader::write(const FrameView& view, const RayQueue& queue) {
  if (written_ == 0) return;
  if (buffer_.bytes() < written_ * sizeof(shared::Ray)) {
    buffer_ = gl::Buffer();  // the old memory goes before the new comes
    buffer_ = gl::Buffer(*api_, (written_ + written_ / 4) * sizeof(shared::Ray), "rays for the host",
                         gl::BufferUse::readback);
    memory_ = static_cast<const shared::Ray*>(
        api_->MapNamedBufferRange(buffer_.name(), 0, static_cast<GLsizeiptr>(buffer_.bytes()),
                                  GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT));
    if (!memory_) throw Error(ErrorKind::failed, "the driver cannot map a buffer for rays");
  }
  const std::uint32_t slice = maxRaysOf(*api_);
  for (std::uint32_t first = 0; first < written_; first += slice) {
    const std::uint32_t some = std::min(slice, written_ - first);
    program_->use();
    program_->set("firstRay", first);
    view.bindRays(queue);
    api_->BindBufferRange(GL_SHADER_STORAGE_BUFFER, SSBO_READ_RAYS, buffer_.name(),
                          static_cast<GLintptr>(first * sizeof(shared::Ray)),
                          static_cast<GLsizeiptr>(some * sizeof(shared::Ray)));
    api_->DispatchCompute((some + kGroup - 1) / kGroup, 1, 1);
  }
  // The rays (these dispatches) are read by the host through mapped memory.
  api_->MemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
}

}  // namespace halfsilver
