#include "tracing/build_counters.h"

#include <array>

#include "shared/passes/build_counters.h"
#include "shared/tracing.h"

namespace halfsilver {

BuildCounters::BuildCounters(const gl::Api& api)
    : api_(&api), counters_(api, COUNTER_SLOTS * COUNTER_KINDS * sizeof(GLuint), "build counters"), read_(api) {
  clear();
}

void BuildCounters::bind() const { counters_.bindStorage(SSBO_COUNTERS); }

std::uint64_t BuildCounters::sum(std::uint32_t kind) {
  // Counts (shaders) are read by the host.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  return sumOfCounter(read_.read<std::array<GLuint, COUNTER_SLOTS * COUNTER_KINDS>>(counters_), kind);
}

std::uint64_t sumOfCounter(std::span<const std::uint32_t> counters, std::uint32_t kind) {
  std::uint64_t sum = 0;
  for (std::size_t slot = 0; slot < COUNTER_SLOTS; ++slot) sum += counters[slot * COUNTER_KINDS + kind];
  return sum;
}

void addFragmentCounts(std::span<const std::uint32_t> counters, TracerMemory& memory) {
  memory.fragments = sumOfCounter(counters, COUNTER_FRAGMENTS);
  memory.lostFragments += sumOfCounter(counters, COUNTER_LOST);
  for (std::uint32_t axis = 0; axis < 3; ++axis) memory.perAxis[axis] = sumOfCounter(counters, COUNTER_STORED_X + axis);
}

}  // namespace halfsilver
