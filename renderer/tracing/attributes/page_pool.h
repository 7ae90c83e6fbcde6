#pragma once

#include <cstdint>
#include <vector>

#include <halfsilver/gl/buffer.h>
#include <halfsilver/tracer.h>
#include "gl/program.h"
#include "tracing/build_counters.h"

namespace halfsilver {

// The defines of every shader that touches lists of pages of this size.
std::vector<gl::Define> pageDefines(int pageSize);

// The lists of a paged A-buffer: heads, links and the counters of a build; the entries themselves belong to the method.
// See shaders/tracing/attributes/pages.glsl. The pool's size follows the build before: it grows between builds when
// fragments were lost, and shrinks when it was far too large (Kastrati & Goswami 2017, section 3.2.1, grows only).
class PagePool {
 public:
  PagePool(const gl::Api& api, int pageSize)
      : api_(&api), pageSize_(static_cast<std::uint32_t>(pageSize)), counters_(api) {}

  // Clears for a build of `heads` lists. The first build gets room for `firstEntries`; later ones for what the build
  // before asked for, at most `maxEntries`. Waits for that build's counters. May change capacity().
  void begin(std::size_t heads, std::uint64_t firstEntries, std::uint64_t maxEntries);

  void bind() const;  // SSBO_HEADS, SSBO_LINKS

  std::uint32_t pages() const { return pages_; }
  std::uint64_t capacity() const { return static_cast<std::uint64_t>(pages_) * pageSize_; }  // entries

  BuildCounters& counters() { return counters_; }
  const BuildCounters& counters() const { return counters_; }

  std::uint64_t headBytes() const { return heads_.bytes(); }
  std::uint64_t linkBytes() const { return links_.bytes(); }

  // Fills what a pool with entries of this size knows: heads and pool. addCounts(): fragments, of a copy of the
  // counters.
  void report(TracerMemory& memory, std::uint64_t entryBytes) const;
  static void addCounts(std::span<const std::uint32_t> counters, TracerMemory& memory);

 private:
  const gl::Api* api_;
  std::uint32_t pageSize_;
  std::uint32_t pages_ = 0;
  gl::Buffer heads_, links_;
  BuildCounters counters_;
};

}  // namespace halfsilver
