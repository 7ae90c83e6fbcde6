#include "tracing/trace_pass.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "gl/draw_state.h"
#include "shared/passes/trace.h"

namespace halfsilver {
namespace {

// Iterations after which a ray yields if the driver stops shaders at 65,535 of them in a vector of eight rays.
constexpr int kSoftwareWorkLimit = 4000;
// Dispatches after which the rest is given up; a ray does at least a voxel in each.
constexpr int kMaxDispatches = 1024;

constexpr std::size_t kUnfinishedOffset = offsetof(shared::RayCount, unfinished);

}  // namespace

TracePass::TracePass(const gl::Api& api, TraceStage stage, const std::string& folder,
                     std::span<const gl::Define> defines)
    : api_(&api),
      stage_(stage),
      program_(stage == TraceStage::compute
                   ? gl::Program::compute(api, folder + "/trace.comp", defines)
                   : gl::Program::raster(api, "passes/fullscreen.vert", folder + "/trace.frag", defines)),
      vertexArray_(api),
      read_(api) {}

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
    gl::DrawState{.viewport = {0, 0, rowLength, rows}}.apply(*api_);
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

void TracePass::run(const FrameView& view, const RayQueue& rays, const Hits& hits, const Structure& structure) {
  const bool limited = api_->software;
  const bool once = !limited && !structure.supply;  // then no ray pauses
  const std::size_t pausedBytes = (once ? 1 : rays.capacity) * sizeof(shared::PausedRay);
  if (paused_.bytes() < pausedBytes) {
    paused_ = gl::Buffer();
    paused_ = gl::Buffer(*api_, pausedBytes, "paused rays");
  }
  // The queue (selection, shading) is read as arguments of the dispatch and by the trace.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  program_.set("workLimit", limited ? kSoftwareWorkLimit : std::numeric_limits<int>::max());
  bool more = !once;
  for (int i = 0; i < kMaxDispatches; ++i) {
    more = more && i + 1 < kMaxDispatches;
    {
      const auto scope = view.profiler.section("trace");
      bind(view, rays, hits);
      structure.bind();
      program_.set("resuming", i > 0 ? 1 : 0);
      program_.set("lastDispatch", more ? 0 : 1);
      dispatch(rays);
      if (!more) break;
      if (read_.read<GLuint>(rays.count, kUnfinishedOffset / sizeof(GLuint)) == 0) break;
      const GLuint none = 0;
      // Written through the buffer, which GL orders against the dispatches.
      api_->NamedBufferSubData(rays.count.name(), static_cast<GLintptr>(kUnfinishedOffset), sizeof(none), &none);
    }
    if (structure.supply) more = structure.supply();
  }
}

}  // namespace halfsilver
