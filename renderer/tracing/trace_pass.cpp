#include "tracing/trace_pass.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "gl/draw_state.h"

namespace halfsilver {
namespace shared {

#include "shared/passes/trace.h"

static_assert(offsetof(Resume, vertices) == 0);
static_assert(offsetof(Resume, groupsX) == 16);
static_assert(offsetof(Resume, times) == 28);
static_assert(offsetof(Resume, count) == 32);
static_assert(offsetof(Resume, readFrom) == 36);
static_assert(offsetof(Resume, writeTo) == 40);
static_assert(sizeof(Resume) == 48);

}  // namespace shared

namespace {

// Rays and their indices, twice.
std::uint64_t resumeBytes(std::uint64_t rays) { return sizeof(shared::Resume) + 2 * rays * sizeof(GLuint); }

// Iterations after which a ray yields if the driver stops shaders at 65,535 of them in a vector of eight rays.
constexpr int kSoftwareWorkLimit = 4000;
// Rays per dispatch of hardware, which is reset if one takes seconds: the slowest integrated GPUs need some 0.2 s for
// these.
constexpr std::uint32_t kRaysPerDispatch = 1u << 20;
static_assert(kRaysPerDispatch / TRACE_GROUP <= 65535);
// Dispatches after which the rest is given up; a ray does at least a voxel in each.
constexpr int kMaxDispatches = 1024;

gl::Program makeProgram(const gl::Api& api, const TraceSettings& settings, const std::string& folder,
                        std::vector<gl::Define> defines) {
  if (settings.countWork) defines.push_back({"COUNT_WORK"});
  return settings.stage == TraceStage::compute
             ? gl::Program::compute(api, folder + "/trace.comp", defines)
             : gl::Program::raster(api, "passes/fullscreen.vert", folder + "/trace.frag", defines);
}

// For as many rays as the largest queue has.
void reserve(const gl::Api& api, std::size_t bytes, const char* label, gl::Buffer& buffer) {
  if (buffer.bytes() >= bytes) return;
  buffer = gl::Buffer();  // the old memory goes before the new comes
  buffer = gl::Buffer(api, bytes, label);
}

}  // namespace

TracePass::TracePass(const gl::Api& api, const TraceSettings& settings, const std::string& folder,
                     std::vector<gl::Define> defines)
    : api_(&api),
      settings_(settings),
      program_(makeProgram(api, settings, folder, std::move(defines))),
      resume_(gl::Program::compute(api, "tracing/common/resume.comp")),
      vertexArray_(api),
      look_(api) {}

void TracePass::dispatchWaiting() const {
  api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, resumeWork_.name());
  api_->DispatchComputeIndirect(offsetof(shared::Resume, groupsX));
}

// Rays beyond the queue's count, which stays on the GPU, end at once.
void TracePass::dispatchFragments(const RayQueue& rays, bool resuming) const {
  const auto rowLength = static_cast<GLuint>(std::min(api_->limits.framebufferSize, 8192));
  const GLuint rows = std::max(1u, (rays.capacity + rowLength - 1) / rowLength);
  const GLuint rowsPerDraw = api_->software ? rows : std::max(1u, kRaysPerDispatch / rowLength);
  const gl::Framebuffer framebuffer(*api_, static_cast<int>(rowLength), static_cast<int>(rows));
  framebuffer.bind();
  vertexArray_.bind();
  program_.set("rowLength", rowLength);
  for (GLuint row = 0; row < rows; row += rowsPerDraw) {
    if (row > 0) api_->Flush();
    gl::DrawState{.viewport = {0, row, rowLength, std::min(rowsPerDraw, rows - row)}}.apply(*api_);
    if (resuming) {
      api_->BindBuffer(GL_DRAW_INDIRECT_BUFFER, resumeWork_.name());
      api_->DrawArraysIndirect(GL_TRIANGLES, nullptr);
    } else {
      api_->DrawArrays(GL_TRIANGLES, 0, 3);
    }
  }
}

void TracePass::dispatch(const RayQueue& rays, bool resuming) const {
  program_.use();
  if (settings_.stage == TraceStage::fragment) {
    dispatchFragments(rays, resuming);
  } else if (!api_->software && rays.capacity > kRaysPerDispatch) {
    for (std::uint32_t first = 0; first < rays.capacity; first += kRaysPerDispatch) {
      if (first > 0) api_->Flush();
      program_.set("firstRay", first);
      api_->DispatchCompute((std::min(kRaysPerDispatch, rays.capacity - first) + TRACE_GROUP - 1) / TRACE_GROUP, 1, 1);
    }
  } else {
    program_.set("firstRay", 0u);
    if (resuming) {
      dispatchWaiting();
    } else {
      api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, rays.count.name());
      api_->DispatchComputeIndirect(0);
    }
  }
  // Hits and counts (trace) are read by the next dispatch, by shading and by the host.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void TracePass::bind(const FrameView& view, const RayQueue& rays, const Hits& hits) const {
  view.scene.bindSurfaces();
  view.bindRays(rays);
  hits.hits.bindStorage(SSBO_HITS);
  if (hits.surfaces) hits.surfaces.bindStorage(SSBO_HIT_SURFACES);
  paused_.bindStorage(SSBO_PAUSED);
  resumeWork_.bindStorage(SSBO_RESUME);
  if (work_) work_.bindStorage(SSBO_RAY_WORK);
}

void TracePass::prepareResume(const FrameView& view, const RayQueue& rays) const {
  const auto scope = view.profiler.section("trace");
  rays.count.bindStorage(SSBO_RAY_COUNT);
  resumeWork_.bindStorage(SSBO_RESUME);
  resume_.use();
  api_->DispatchCompute(1, 1, 1);
  // Arguments and the count (this dispatch) are read and counted up by the trace.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

int TracePass::run(const FrameView& view, const RayQueue& rays, const Hits& hits, const Structure& structure) {
  const bool limited = api_->software;
  const int dispatches = structure.certain && !limited ? 1 : structure.dispatches;
  const bool once = !limited && (!structure.supply || structure.certain);  // then no ray pauses
  reserve(*api_, (once ? 1 : rays.capacity) * sizeof(shared::PausedRay), "paused rays", paused_);
  reserve(*api_, resumeBytes(once ? 1 : rays.capacity), "resumed rays", resumeWork_);
  if (settings_.countWork) reserve(*api_, rays.capacity * sizeof(shared::RayWork), "work of rays", work_);
  const shared::Resume none{};
  resumeWork_.write(0, &none, sizeof(none));
  // The queue (selection, shading) is read as arguments of the dispatch and by the trace.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  program_.set("workLimit", limited ? kSoftwareWorkLimit : std::numeric_limits<int>::max());
  bool more = !once;
  int untilLook = dispatches, between = dispatches;
  for (int i = 1;; ++i) {
    const bool last = !more || i == kMaxDispatches || (structure.certain && i == dispatches);
    {
      const auto scope = view.profiler.section("trace");
      bind(view, rays, hits);
      structure.bind();
      program_.set("resuming", i > 1 ? 1 : 0);
      program_.set("lastDispatch", last ? 1 : 0);
      dispatch(rays, i > 1);
    }
    if (last) return i;
    if (--untilLook == 0) {
      constexpr std::size_t kUnfinished = offsetof(shared::RayCount, unfinished) / sizeof(GLuint);
      constexpr std::size_t kTimes = offsetof(shared::Resume, times) / sizeof(GLuint);
      look_.clear();
      const auto unfinished = look_.copy<GLuint>(rays.count, 1, kUnfinished);
      const auto times = look_.copy<GLuint>(resumeWork_, 1, kTimes);
      if (structure.copy) structure.copy(look_);
      look_.submit();
      look_.wait();
      const bool done = look_.values(unfinished)[0] == 0;
      if (structure.settle) more = structure.settle(look_, done);
      if (done) return 1 + static_cast<int>(look_.values(times)[0]);
      untilLook = between *= 2;
    }
    prepareResume(view, rays);
    if (more && structure.supply) {
      structure.supply([&](const gl::Program& program) {
        const auto scope = view.profiler.section("trace");
        bind(view, rays, hits);
        structure.bind();
        program.use();
        dispatchWaiting();
        // What waiting rays ask for is read by what makes it, as data and as the size of its dispatches.
        api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
      });
    }
  }
}

}  // namespace halfsilver
