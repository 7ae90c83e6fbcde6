#include "tracing/identity/prefix_sum.h"

#include <algorithm>

#include "tracing/identity/brick_work.h"

namespace halfsilver {
namespace {

constexpr std::uint32_t kMaxGroups = 65535;

std::uint32_t blocksOf(std::uint32_t items) { return std::max(1u, (items + SUM_GROUP - 1) / SUM_GROUP); }

gl::Program step(const gl::Api& api, const char* file, const char* number) {
  const gl::Define defines[] = {{"STEP", number}};
  return gl::Program::compute(api, file, defines);
}

}  // namespace

PrefixSum::PrefixSum(const gl::Api& api, const char* file)
    : api_(&api), sumBlocks_(step(api, file, "0")), sumSums_(step(api, file, "1")), place_(step(api, file, "2")) {}

void PrefixSum::sum(std::uint32_t items, const BindItems& bind) {
  const std::size_t bytes = blocksOf(items) * sizeof(GLuint);
  if (blocks_.bytes() < bytes) {
    blocks_ = gl::Buffer();
    blocks_ = gl::Buffer(*api_, bytes, "sums of blocks");
  }
  run(sumBlocks_, items, blocksOf(items), bind);
  run(sumSums_, items, 1, bind);
}

void PrefixSum::place(std::uint32_t items, const BindItems& bind) { run(place_, items, blocksOf(items), bind); }

void PrefixSum::run(const gl::Program& program, std::uint32_t items, std::uint32_t groups, const BindItems& bind) {
  blocks_.bindStorage(SSBO_BLOCK_SUMS);
  bind();
  program.set("itemCount", items);
  program.set("blockCount", blocksOf(items));
  program.use();
  const std::uint32_t rows = (groups + kMaxGroups - 1) / kMaxGroups;
  api_->DispatchCompute(std::min(groups, kMaxGroups), rows, 1);
  // Sums and items (this step) are read by the next step and by what follows.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace halfsilver
