#pragma once

#include <cstdint>
#include <span>

#include <halfsilver/gl/buffer.h>
#include <halfsilver/gl/readback.h>
#include <halfsilver/tracer.h>

namespace halfsilver {

// Counts of a build, spread over slots so that atomics collide less; see shaders/shared/tracing.h for the kinds.
class BuildCounters {
 public:
  explicit BuildCounters(const gl::Api& api);

  void clear() { counters_.fill(0); }
  // One word of slot 0, for steps that signal through a counter.
  void clear(std::uint32_t kind) { counters_.fill(0, kind * sizeof(GLuint), sizeof(GLuint)); }
  void bind() const;  // SSBO_COUNTERS

  // One kind, summed over its slots. Waits for the GPU.
  std::uint64_t sum(std::uint32_t kind);

  const gl::Buffer& buffer() const { return counters_; }
  std::uint64_t bytes() const { return counters_.bytes(); }

 private:
  const gl::Api* api_;
  gl::Buffer counters_;
  gl::BlockingRead read_;
};

// One kind of a copy of the counters, summed over its slots.
std::uint64_t sumOfCounter(std::span<const std::uint32_t> counters, std::uint32_t kind);
// TracerMemory::fragments and perAxis of a copy of the counters; adds to lostFragments what was stored nowhere.
void addFragmentCounts(std::span<const std::uint32_t> counters, TracerMemory& memory);

}  // namespace halfsilver
