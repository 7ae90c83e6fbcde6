#include "tracing/trace_pass.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "shared/tracing.h"

namespace halfsilver {
namespace {

// Iterations after which a ray yields, where the driver stops shaders at 65,535 of them in a vector of eight rays.
constexpr int kSoftwareWorkLimit = 4000;
// Dispatches after which the rest is given up; a ray does at least a voxel in each.
constexpr int kMostDispatches = 1024;

constexpr GLintptr kUnfinishedOffset = offsetof(shared::RayCount, unfinished);

}  // namespace

TracePass::TracePass(const gl::Api& api, TraceStage stage, std::span<const gl::Define> defines)
    : api_(&api),
      stage_(stage),
      program_(stage == TraceStage::compute
                   ? gl::Program::compute(api, "tracing/trace.comp", defines)
                   : gl::Program::raster(api, "passes/fullscreen.vert", "tracing/trace.frag", defines)),
      vertexArray_(api) {}

void TracePass::dispatch(const RayQueue& rays) const {
  program_.use();
  if (stage_ == TraceStage::compute) {
    api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, rays.count.name());
    api_->DispatchComputeIndirect(0);
  } else {
    // Fragments beyond the queue's count end at once; the count itself stays on the GPU.
    const auto rowLength = static_cast<GLuint>(std::min(api_->limits.framebufferSize, 8192));
    const GLuint rows = std::max(1u, (rays.capacity + rowLength - 1) / rowLength);
    const gl::Framebuffer framebuffer(*api_, static_cast<int>(rowLength), static_cast<int>(rows));
    framebuffer.bind();
    api_->Viewport(0, 0, static_cast<GLsizei>(rowLength), static_cast<GLsizei>(rows));
    for (const GLenum state : {GL_DEPTH_TEST, GL_CULL_FACE, GL_BLEND, GL_SCISSOR_TEST, GL_STENCIL_TEST})
      api_->Disable(state);
    vertexArray_.bind();
    program_.set("rowLength", rowLength);
    api_->DrawArrays(GL_TRIANGLES, 0, 3);
  }
  // Hits and counts (trace) are read by the next dispatch, by shading and by the host.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void TracePass::bind(const FrameView& view, const RayQueue& rays, const Hits& hits) const {
  view.constants.bindUniform(UBO_FRAME);
  view.scene.bindSurfaces();
  rays.rays.bindStorage(SSBO_RAYS);
  rays.count.bindStorage(SSBO_RAY_COUNT);
  hits.hits.bindStorage(SSBO_HITS);
  if (hits.surfaces) hits.surfaces.bindStorage(SSBO_HIT_SURFACES);
  paused_.bindStorage(SSBO_PAUSED);
}

void TracePass::run(const FrameView& view, const RayQueue& rays, const Hits& hits, const Supply& supply) {
  const std::size_t pausedBytes = rays.capacity * sizeof(shared::PausedRay);
  if (paused_.bytes() < pausedBytes) {
    paused_ = gl::Buffer();
    paused_ = gl::Buffer(*api_, pausedBytes, "paused rays");
  }
  // The queue (selection, shading) is read as arguments of the dispatch and by the trace.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  const bool limited = api_->software;
  const bool once = !limited && !supply;
  program_.set("workLimit", limited ? kSoftwareWorkLimit : std::numeric_limits<int>::max());
  bool more = !once;
  for (int i = 0; i < kMostDispatches; ++i) {
    more = more && i + 1 < kMostDispatches;
    GLuint unfinished = 0;
    {
      const auto scope = view.profiler.section("trace");
      bind(view, rays, hits);
      program_.set("resuming", i > 0 ? 1 : 0);
      program_.set("lastDispatch", more ? 0 : 1);
      dispatch(rays);
      if (!more) break;
      rays.count.read(kUnfinishedOffset, &unfinished, sizeof(unfinished));
      if (unfinished == 0) break;
      const GLuint none = 0;
      // Written through the buffer, which GL orders against the dispatches.
      api_->NamedBufferSubData(rays.count.name(), kUnfinishedOffset, sizeof(none), &none);
    }
    if (supply) more = supply();
  }
}

}  // namespace halfsilver
