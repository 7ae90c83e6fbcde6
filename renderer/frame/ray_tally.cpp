#include "frame/ray_tally.h"

#include "shared/passes/tally.h"

namespace halfsilver {

std::size_t RayTally::bytes() const {
  std::size_t sum = 0;
  for (const gl::Buffer& kind : kinds) sum += kind.bytes();
  return sum;
}

void RayTallyPass::begin(const FrameView& view, RayTally& tally) const {
  const std::size_t bytes = std::size_t{view.frame.width} * view.frame.height * sizeof(shared::KindTally);
  // The last frame's shaders wrote them; the fill overwrites them.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  for (gl::Buffer& kind : tally.kinds) {
    if (kind.bytes() != bytes) {
      kind = gl::Buffer();  // the old memory goes before the new comes
      kind = gl::Buffer(*api_, bytes, "tally of rays");
    }
    kind.fill(0);
  }
}

void RayTallyPass::add(const FrameView& view, const RayQueue& rays, const Hits& hits, bool any, const RayTally& tally) {
  if (!program_) program_ = gl::Program::compute(*api_, "passes/tally.comp");
  program_.use();
  program_.set("anyHit", any ? 1u : 0u);
  view.bindRays(rays);
  // Queues of pixels have no paths, and the shader does not look.
  (rays.ofPixels() ? rays.rays : rays.paths).bindStorage(SSBO_PATHS);
  hits.hits.bindStorage(SSBO_HITS);
  api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, rays.count.name());
  for (std::size_t kind = 0; kind < tally.kinds.size(); ++kind) {
    program_.set("kind", static_cast<unsigned>(kind));
    tally.kinds[kind].bindStorage(SSBO_TALLY);
    api_->DispatchComputeIndirect(0);
  }
  // The tally is added to by the next queue and read by the layers.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

}  // namespace halfsilver
