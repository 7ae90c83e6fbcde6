#include <halfsilver/ray_reader.h>

#include <algorithm>

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
    : api_(&api), program_(std::make_unique<gl::Program>(gl::Program::compute(api, "passes/read_rays.comp"))) {}
RayReader::~RayReader() = default;
RayReader::RayReader(RayReader&&) noexcept = default;
RayReader& RayReader::operator=(RayReader&&) noexcept = default;

void RayReader::submit(const FrameView& view, const RayQueue& rays, std::uint32_t count) {
  fence_ = gl::Fence();
  count_ = std::min(count, rays.capacity);
  if (count_ == 0) return;
  if (buffer_.bytes() < count_ * sizeof(shared::Ray)) {
    buffer_ = gl::Buffer();  // the old memory goes before the new comes
    buffer_ =
        gl::Buffer(*api_, (count_ + count_ / 4) * sizeof(shared::Ray), "rays for the host", gl::BufferUse::readback);
    memory_ = static_cast<const shared::Ray*>(
        api_->MapNamedBufferRange(buffer_.name(), 0, static_cast<GLsizeiptr>(buffer_.bytes()),
                                  GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT));
    if (!memory_) throw Error(ErrorKind::failed, "the driver cannot map a buffer for rays");
  }
  const std::uint32_t slice = maxRaysOf(*api_);
  for (std::uint32_t first = 0; first < count_; first += slice) {
    const std::uint32_t some = std::min(slice, count_ - first);
    program_->use();
    program_->set("firstRay", first);
    view.bindRays(rays);
    api_->BindBufferRange(GL_SHADER_STORAGE_BUFFER, SSBO_READ_RAYS, buffer_.name(),
                          static_cast<GLintptr>(first * sizeof(shared::Ray)),
                          static_cast<GLsizeiptr>(some * sizeof(shared::Ray)));
    api_->DispatchCompute((some + kGroup - 1) / kGroup, 1, 1);
  }
  // The rays (these dispatches) are read by the host through mapped memory.
  api_->MemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
  fence_ = gl::Fence(*api_);
}

std::span<const shared::Ray> RayReader::rays() const {
  if (count_ == 0) return {};
  fence_.wait();
  return {memory_, count_};
}

}  // namespace halfsilver
