#include <halfsilver/gl/readback.h>

#include <algorithm>
#include <utility>

#include <halfsilver/error.h>

namespace halfsilver::gl {
namespace {

constexpr std::size_t kBlockBytes = 16 * 1024;
constexpr GLuint64 kWaitNanoseconds = 1'000'000'000;

}  // namespace

Fence::Fence(const Api& api) : api_(&api), sync_(api.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0)) { api.Flush(); }

Fence::~Fence() {
  if (sync_) api_->DeleteSync(sync_);
}

Fence::Fence(Fence&& other) noexcept : api_(other.api_), sync_(std::exchange(other.sync_, nullptr)) {}

Fence& Fence::operator=(Fence&& other) noexcept {
  std::swap(api_, other.api_);
  std::swap(sync_, other.sync_);
  return *this;
}

bool Fence::signaled() const {
  const GLenum status = api_->ClientWaitSync(sync_, 0, 0);
  return status == GL_ALREADY_SIGNALED || status == GL_CONDITION_SATISFIED;
}

void Fence::wait() const {
  if (!sync_) throw Error(ErrorKind::failed, "a read-back is waited for that was never submitted");
  ++*api_->hostWaits;
  GLenum status = GL_TIMEOUT_EXPIRED;
  while (status == GL_TIMEOUT_EXPIRED) status = api_->ClientWaitSync(sync_, 0, kWaitNanoseconds);
  if (status == GL_WAIT_FAILED) throw Error(ErrorKind::failed, "the GPU does not finish: waiting for it failed");
}

Readback::Place Readback::copyBytes(const Buffer& source, std::size_t offset, std::size_t bytes) {
  if (bytes == 0) return {0, 0};
  while (block_ < blocks_.size() && used_ + bytes > blocks_[block_].buffer.bytes()) {
    // A block that is too small for this even when empty makes room for a larger one: requests that grow from frame to
    // frame do not pile up.
    if (used_ == 0)
      blocks_.erase(blocks_.begin() + static_cast<std::ptrdiff_t>(block_));
    else
      ++block_;
    used_ = 0;
  }
  if (block_ == blocks_.size()) {
    Block block{Buffer(*api_, std::max(bytes + bytes / 2, kBlockBytes), "read-back", BufferUse::readback)};
    block.memory = static_cast<const std::byte*>(
        api_->MapNamedBufferRange(block.buffer.name(), 0, static_cast<GLsizeiptr>(block.buffer.bytes()),
                                  GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT));
    if (!block.memory) throw Error(ErrorKind::failed, "the driver cannot map a buffer for read-backs");
    blocks_.push_back(std::move(block));
  }
  const Place place{block_, used_};
  api_->CopyNamedBufferSubData(source.name(), blocks_[block_].buffer.name(), static_cast<GLintptr>(offset),
                               static_cast<GLintptr>(used_), static_cast<GLsizeiptr>(bytes));
  used_ += (bytes + kAlignment - 1) / kAlignment * kAlignment;
  return place;
}

std::size_t Readback::bytes() const {
  std::size_t sum = 0;
  for (const Block& block : blocks_) sum += block.buffer.bytes();
  return sum;
}

void Readback::submit() { fence_ = Fence(*api_); }

void Readback::wait() const { fence_.wait(); }

void Readback::clear() {
  fence_ = Fence();
  block_ = used_ = 0;
}

}  // namespace halfsilver::gl
