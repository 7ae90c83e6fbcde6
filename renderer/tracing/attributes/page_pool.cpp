#include "tracing/attributes/page_pool.h"

#include <algorithm>
#include <string>
#include <vector>

#include "shared/passes/attributes.h"
#include "shared/tracing.h"

namespace halfsilver {
namespace {

// Room beyond what the build before asked for: a moving scene asks for a little more in every frame.
constexpr double kHeadroom = 1.02;
// A pool is made smaller only if that is worth a new allocation.
constexpr double kWasteful = 1.25;

}  // namespace

std::vector<gl::Define> pageDefines(int pageSize) {
  std::vector<gl::Define> defines{{"PAGE_SIZE", std::to_string(pageSize) + "u"}};
  if (pageSize == 1) defines.push_back({"PAGE_FILL_BITS", "1"});
  return defines;
}

void PagePool::begin(std::size_t heads, std::uint64_t firstEntries, std::uint64_t maxEntries) {
  const std::uint64_t maxPages = std::min<std::uint64_t>(
      {maxEntries / pageSize_, static_cast<std::uint64_t>(api_->limits.storageBlockBytes) / sizeof(GLuint),
       pageSize_ == 1 ? MAX_LINKED_ENTRIES : MAX_PAGES});
  std::uint64_t wanted = pages_;
  if (pages_ == 0) {
    wanted = firstEntries / pageSize_ + 1;
  } else {
    // Every fragment that found no page asked for one of its own, so this is enough, if more than needed.
    const std::uint64_t asked = counters_.sum(COUNTER_PAGES);
    if (asked > pages_ || static_cast<double>(pages_) > kWasteful * static_cast<double>(asked))
      wanted = static_cast<std::uint64_t>(kHeadroom * static_cast<double>(asked)) + 1;
  }
  wanted = std::min(wanted, maxPages);
  if (wanted != pages_) {
    pages_ = 0;
    links_ = gl::Buffer();  // the old one goes first: both at once might not fit
    links_ = gl::Buffer(*api_, wanted * sizeof(GLuint), "page links");
    pages_ = static_cast<std::uint32_t>(wanted);
  }
  if (heads_.bytes() != heads * sizeof(GLuint)) heads_ = gl::Buffer(*api_, heads * sizeof(GLuint), "A-buffer heads");
  heads_.fill(0);
  counters_.clear();
}

void PagePool::bind() const {
  heads_.bindStorage(SSBO_HEADS);
  links_.bindStorage(SSBO_LINKS);
}

void PagePool::report(TracerMemory& memory, std::uint64_t entryBytes) const {
  memory.heads = headBytes();
  memory.poolReserved = capacity() * entryBytes + linkBytes();
  memory.bytesPerFragment = static_cast<double>(entryBytes);
  memory.structureTotal = memory.voxels + memory.heads + memory.poolReserved + counters_.bytes();
}

void PagePool::addCounts(std::span<const std::uint32_t> counters, TracerMemory& memory) {
  addFragmentCounts(counters, memory);
  memory.fragmentsStored = memory.perAxis[0] + memory.perAxis[1] + memory.perAxis[2];
  memory.poolUsed = memory.fragmentsStored * static_cast<std::uint64_t>(memory.bytesPerFragment);
}

}  // namespace halfsilver
