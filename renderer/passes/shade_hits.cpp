#include "passes/shade_hits.h"

#include <cstddef>
#include <vector>

#include <halfsilver/shared_structs.h>

namespace halfsilver {

ShadeHitsPass::ShadeHitsPass(const gl::Api& api)
    : api_(&api), finish_(gl::Program::compute(api, "passes/ray_count.comp")) {}

const gl::Program& ShadeHitsPass::program(bool surfaces, bool next) {
  gl::Program& program = programs_[surfaces][next];
  if (program) return program;
  std::vector<gl::Define> defines;
  if (surfaces) defines.push_back({"HIT_SURFACES"});
  if (next) defines.push_back({"NEXT_BOUNCE"});
  program = gl::Program::compute(*api_, "passes/shade_hits.comp", defines);
  return program;
}

void ShadeHitsPass::clear(const GBuffer& gbuffer, gl::Profiler& profiler) const {
  const auto section = profiler.section("shade");
  api_->ClearTexImage(gbuffer.reflection.name(), 0, GL_RGBA, GL_FLOAT, nullptr);
}

void ShadeHitsPass::run(const RayQueue& rays, const Hits& hits, const GBuffer& gbuffer, RayQueue* next,
                        gl::Profiler& profiler) {
  const auto section = profiler.section("shade");
  rays.rays.bindStorage(SSBO_RAYS);
  rays.count.bindStorage(SSBO_RAY_COUNT);
  hits.hits.bindStorage(SSBO_HITS);
  if (hits.surfaces) hits.surfaces.bindStorage(SSBO_HIT_SURFACES);
  if (next) {
    next->rays.bindStorage(SSBO_NEXT_RAYS);
    next->count.bindStorage(SSBO_NEXT_RAY_COUNT);
    next->count.fill(0, 0, offsetof(shared::RayCount, overflow));  // which counts for the whole frame
  }
  gbuffer.reflection.bindImage(IMAGE_REFLECTION, GL_READ_WRITE);
  program(static_cast<bool>(hits.surfaces), next != nullptr).use();
  api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, rays.count.name());
  api_->DispatchComputeIndirect(0);
  // Reflection and next rays (compute) are read by the next bounce, the composite pass and read-backs.
  api_->MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                      GL_TEXTURE_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  if (!next) return;
  next->count.bindStorage(SSBO_RAY_COUNT);
  finish_.use();
  api_->DispatchCompute(1, 1, 1);
  // The dispatch's size (compute) is read by the next bounce's indirect dispatches and by read-backs.
  api_->MemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

}  // namespace halfsilver
