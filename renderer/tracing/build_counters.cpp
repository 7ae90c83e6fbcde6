#include "tracing/build_counters.h"

#include <vector>

#include "shared/bindings.h"
#include "shared/tracing.h"

namespace halfsilver {

BuildCounters::BuildCounters(const gl::Api& api)
    : api_(&api), counters_(api, COUNTER_SLOTS * COUNTER_KINDS * sizeof(GLuint), "build counters") {
  clear();
}

void BuildCounters::bind() const { counters_.bindStorage(SSBO_COUNTERS); }

std::uint64_t BuildCounters::sum(std::uint32_t kind) const {
  // Counts (shaders) are read by the host.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const std::vector<GLuint> values = counters_.read<GLuint>(COUNTER_SLOTS * COUNTER_KINDS);
  std::uint64_t sum = 0;
  for (std::size_t slot = 0; slot < COUNTER_SLOTS; ++slot) sum += values[slot * COUNTER_KINDS + kind];
  return sum;
}

}  // namespace halfsilver
