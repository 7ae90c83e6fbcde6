#include "tracing/identity/run_store.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "shared/passes/voxelize.h"
#include "shared/tracing.h"
#include "tracing/identity/resize.h"
#include "tracing/raster.h"

namespace halfsilver {
namespace {

constexpr std::uint64_t kWordBytes = sizeof(GLuint);
constexpr double kVoxelsPerBrick = BRICK_SIDE * BRICK_SIDE * BRICK_SIDE;
// Software rasterizers stop long loops, and one invocation copies a run.
constexpr std::uint64_t kMaxSoftwareCopy = 8000;
// Room beyond what is needed if a pool grows that already holds lists: the next frame will want a little more. And the
// share of stale words above which runs are moved together.
constexpr double kHeadroom = 1.03;

}  // namespace

// Only conservative voxels hold every triangle, so the other rasters of VoxelRaster are not offered here.
RunStore::RunStore(const gl::Api& api, const Settings& settings)
    : api_(&api),
      resolution_(settings.voxels.resolution),
      voxelsPerTriangle_(static_cast<double>(settings.identity.voxelsPerTriangle)),
      ownAxis_(settings.voxels.axis == AxisRule::own),
      voxelPass_(api, VoxelRaster::conservative, settings.voxels.axis),
      beginBricks_(gl::Program::compute(api, "tracing/identity/begin_bricks.comp")),
      read_(api),
      work_(api, sizeof(shared::BrickWork), "work on bricks") {}

Grid RunStore::brickGridOf(const GpuScene& scene) const {
  const double voxels = voxelsPerTriangle_ * static_cast<double>(scene.triangleCount);
  const double wanted = voxelsPerTriangle_ > 0 ? std::max(1.0, voxels / kVoxelsPerBrick) : 0.0;
  return makeCubicGrid(scene.extents.core().bounds, std::max(1, resolution_ / BRICK_SIDE), wanted);
}

void RunStore::setOuter(std::span<const std::uint32_t> triangles) {
  std::vector<GLuint> outer = {static_cast<GLuint>(triangles.size())};
  outer.insert(outer.end(), triangles.begin(), triangles.end());
  outer_ = gl::makeBuffer(*api_, std::span<const GLuint>(outer), "triangles beyond the grid");
}

void RunStore::start(const FrameView& view, const Grid& bricks) {
  grid_ = brickGrid_ = bricks;
  grid_.voxels *= BRICK_SIDE;
  voxelPass_.run(view, brickGrid_, voxels_);
  noteTransient(voxelPass_.transientBytes());
  const auto scope = view.profiler.section("voxelize");
  forget();
}

void RunStore::forget() {
  resize(*api_, bricks_, brickCount() * sizeof(GLuint), "A-buffer bricks");
  if (!runs_) resize(*api_, runs_, 0, "A-buffer runs");
  clearWork();
  used_ = headerWords_ = staleWords_ = staleHeaderWords_ = longestRun_ = lost_ = 0;
  bind();
  beginBricks_.set("brickCount", brickCount());
  dispatchFor(*api_, beginBricks_, brickCount());
  // States (compute) are read and written by the trace.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}

void RunStore::bind() const {
  voxels_.words.bindStorage(SSBO_VOXELS);
  bricks_.bindStorage(SSBO_BRICKS);
  runs_.bindStorage(SSBO_RUNS);
  work_.bindStorage(SSBO_BRICK_WORK);
}

void RunStore::clearWork() { work_.fill(0); }

shared::BrickWork RunStore::readWork() {
  // Requests and counts (shaders) are read by the host.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  return read_.read<shared::BrickWork>(work_);
}

std::optional<std::uint32_t> RunStore::makeRoom(std::uint64_t words, std::uint64_t besides) {
  const std::uint64_t needed = used_ + words;
  // Higher places are states of bricks.
  const std::uint64_t max =
      std::min<std::uint64_t>(static_cast<std::uint64_t>(api_->limits.storageBlockBytes) / kWordBytes, BRICK_REQUESTED);
  if (needed > max) return std::nullopt;
  const auto place = static_cast<std::uint32_t>(used_);
  // A pool of an earlier geometry that is much too large goes, too.
  if (needed <= capacity() && (used_ > 0 || static_cast<double>(capacity()) <= kHeadroom * static_cast<double>(needed)))
    return place;
  if (used_ == 0) {
    resize(*api_, runs_, needed * kWordBytes, "A-buffer runs");
    return place;
  }
  const auto wanted = std::min(max, static_cast<std::uint64_t>(kHeadroom * static_cast<double>(needed)));
  gl::Buffer larger(*api_, wanted * kWordBytes, "A-buffer runs");
  noteTransient(besides + runs_.bytes());
  // Runs (fragments) are copied.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  api_->CopyNamedBufferSubData(runs_.name(), larger.name(), 0, 0, static_cast<GLsizeiptr>(used_ * kWordBytes));
  runs_ = std::move(larger);
  return place;
}

void RunStore::addBuilt(const shared::BrickWork& work) {
  used_ += work.totalWords;
  headerWords_ += work.headerWords;
  longestRun_ = std::max<std::uint64_t>(longestRun_, work.longestRun);
}

void RunStore::addStale(const shared::BrickWork& work) {
  staleWords_ += work.staleWords;
  staleHeaderWords_ += work.staleHeaderWords;
}

bool RunStore::compact(std::uint64_t besides) {
  const std::uint64_t left = used_ - staleWords_;
  if (static_cast<double>(used_) <= kHeadroom * static_cast<double>(left)) return true;
  if (api_->software && longestRun_ > kMaxSoftwareCopy) {
    forget();
    return false;
  }
  if (!compactSum_) compactSum_.emplace(*api_, "tracing/identity/compact_runs.comp");
  const std::uint64_t wanted =
      std::min(capacity(), static_cast<std::uint64_t>(kHeadroom * static_cast<double>(left)) + 4);
  gl::Buffer together(*api_, wanted * kWordBytes, "A-buffer runs");
  noteTransient(besides + runs_.bytes());
  const auto bindItems = [&] {
    bind();
    together.bindStorage(SSBO_COMPACTED_RUNS);
  };
  compactSum_->sum(brickCount(), bindItems);
  compactSum_->place(brickCount(), bindItems);
  runs_ = std::move(together);
  used_ -= staleWords_;
  headerWords_ -= staleHeaderWords_;
  staleWords_ = staleHeaderWords_ = 0;
  return true;
}

void RunStore::shrink() {
  if (used_ == 0) resize(*api_, runs_, 0, "A-buffer runs");
}

void RunStore::report(TracerMemory& memory) const {
  memory.grid = grid_.voxels;
  memory.voxels = voxels_.bytes() + bricks_.bytes();
  memory.heads = headerWords_ * kWordBytes;
  memory.poolReserved = runs_.bytes() - memory.heads;
  memory.fragmentsStored = used_ - headerWords_ - (staleWords_ - staleHeaderWords_);
  memory.poolUsed = memory.fragmentsStored * kWordBytes;
  memory.lostFragments = lost_;
  memory.bytesPerFragment = static_cast<double>(kWordBytes);
  memory.structureTotal = memory.voxels + memory.heads + memory.poolReserved + outer_.bytes() + work_.bytes();
  if (compactSum_) memory.structureTotal += compactSum_->bytes();
  memory.transient = transient_;
}

}  // namespace halfsilver
