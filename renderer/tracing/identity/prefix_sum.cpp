#include "tracing/identity/prefix_sum.h"

#include <algorithm>

#include "shared/bindings.h"
#include "shared/tracing.h"

namespace halfsilver {
namespace {

constexpr std::uint32_t kMostGroups = 65535;

std::uint32_t blocksOf(std::uint32_t items) { return std::max(1u, (items + SUM_GROUP - 1) / SUM_GROUP); }

gl::Program step(const gl::Api& api, const char* items, const char* number) {
  const gl::Define defines[] = {{items}, {"STEP", number}};
  return gl::Program::compute(api, "tracing/prefix_sum.comp", defines);
}

}  // namespace

PrefixSum::PrefixSum(const gl::Api& api, const char* items)
    : api_(&api), sumBlocks_(step(api, items, "0")), sumSums_(step(api, items, "1")), place_(step(api, items, "2")) {}

void PrefixSum::sum(std::uint32_t items) {
  const std::size_t bytes = blocksOf(items) * sizeof(GLuint);
  if (blocks_.bytes() < bytes) {
    blocks_ = gl::Buffer();
    blocks_ = gl::Buffer(*api_, bytes, "sums of blocks");
  }
  run(sumBlocks_, items, blocksOf(items));
  run(sumSums_, items, 1);
}

void PrefixSum::place(std::uint32_t items) { run(place_, items, blocksOf(items)); }

void PrefixSum::run(const gl::Program& program, std::uint32_t items, std::uint32_t groups) {
  blocks_.bindStorage(SSBO_LINKS);
  program.set("itemCount", items);
  program.set("blockCount", blocksOf(items));
  program.use();
  const std::uint32_t rows = (groups + kMostGroups - 1) / kMostGroups;
  api_->DispatchCompute(std::min(groups, kMostGroups), rows, 1);
  // Sums (this step) are read by the next step, by what follows and, the total, by the host.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

}  // namespace halfsilver
