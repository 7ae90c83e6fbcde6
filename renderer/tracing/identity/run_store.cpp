#include "tracing/identity/run_store.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "shared/passes/voxelize.h"
#include "shared/tracing.h"
#include "tracing/raster.h"
#include "tracing/resize.h"

namespace halfsilver {
namespace {

constexpr std::uint64_t kWordBytes = sizeof(GLuint);
constexpr double kVoxelsPerBrick = VOXELS_PER_BRICK;
// Of the longest side of the scene, around it; see brickGridOf(). A grid with twice as much is too large.
constexpr float kRoom = 0.1f;
// Software rasterizers stop long loops, and one invocation copies a run.
constexpr std::uint64_t kMaxSoftwareCopy = 8000;
// The pool over its runs: as fit() makes it, which is also how many stale words there may be, and how much less or more
// may stay. While something moves there is room for the next frame, which builds about as much as the last one.
struct Headroom {
  double made, least, most;
};
constexpr Headroom kStillHeadroom = {1.03, 1.01, 1.06}, kMovingHeadroom = {1.045, 1.01, 1.045};
// By how much a pool grows at least if runs wait for room.
constexpr double kGrowth = 4;
// Words per triangle that a pool begins with, before it is known what rays need.
constexpr std::uint64_t kFirstWords = 6, kMinFirstWords = 65536;

std::uint64_t times(double factor, std::uint64_t words) {
  return static_cast<std::uint64_t>(factor * static_cast<double>(words));
}

}  // namespace

// Only conservative voxels hold every triangle, so the other rasters of VoxelRaster are not offered here.
RunStore::RunStore(const gl::Api& api, const Settings& settings)
    : api_(&api),
      resolution_(settings.voxels.resolution != 0 ? settings.voxels.resolution : VoxelSettings().resolution),
      voxelsPerTriangle_(static_cast<double>(settings.identity.voxelsPerTriangle)),
      ownAxis_(settings.voxels.axis == AxisRule::own),
      voxelPass_(api, VoxelRaster::conservative, settings.voxels.axis),
      beginBricks_(gl::Program::compute(api, "tracing/identity/begin_bricks.comp")),
      beginBounding_(gl::Program::compute(api, "tracing/identity/begin_bounding.comp")),
      boundEmpty_(gl::Program::compute(api, "tracing/identity/bound_empty.comp")),
      compactRuns_(gl::Program::compute(api, "tracing/identity/compact_runs.comp")),
      work_(api, sizeof(shared::BrickWork), "work on bricks") {}

Grid RunStore::brickGridOf(const GpuScene& scene, bool room) const {
  Bounds bounds = scene.extents.core().bounds;
  if (room) {
    const glm::vec3 margin(kRoom * longestSide(bounds.extent()));
    bounds = {bounds.low - margin, bounds.high + margin};
  }
  const double voxels = voxelsPerTriangle_ * static_cast<double>(scene.triangleCount);
  const double wanted = voxelsPerTriangle_ > 0 ? std::max(1.0, voxels / kVoxelsPerBrick) : 0.0;
  return makeCubicGrid(bounds, std::max(1, resolution_ / BRICK_SIDE), wanted);
}

bool RunStore::suits(const GpuScene& scene) const {
  const Bounds& core = scene.extents.core().bounds;
  return holds(brickGrid_, core) && longestSide(brickGrid_.extent) <= (1 + 4 * kRoom) * longestSide(core.extent());
}

void RunStore::setOuter(std::span<const std::uint32_t> triangles) {
  std::vector<GLuint> outer = {static_cast<GLuint>(triangles.size())};
  outer.insert(outer.end(), triangles.begin(), triangles.end());
  outer_ = gl::makeBuffer(*api_, std::span<const GLuint>(outer), "triangles beyond the grid");
}

void RunStore::start(const FrameView& view, const Grid& bricks) {
  grid_ = brickGrid_ = bricks;
  grid_.voxels *= BRICK_SIDE;
  entryLayout_ = EntryLayout::of(view.scene.triangleCount);
  voxelPass_.run(view.scene, view.profiler, brickGrid_, voxels_);
  noteTransient(voxelPass_.transientBytes());
  const auto scope = view.profiler.section("voxelize");
  forget(view.scene);
}

void RunStore::forget(const GpuScene& scene) {
  resize(*api_, bricks_, brickCount() * sizeof(GLuint), "A-buffer bricks");
  const std::uint64_t words = std::min(maxCapacity(), std::max(kMinFirstWords, kFirstWords * scene.triangleCount));
  if (capacity() < words) resize(*api_, runs_, words * kWordBytes, "A-buffer runs");
  known_ = {};
  // Cubes of all bricks are to be bounded.
  shared::BrickWork work{};
  work.fewGroupsY = work.fewGroupsZ = 1;
  work.filledBelowX = work.filledBelowY = work.filledBelowZ = FILLED_BELOW;
  work.filledAboveX = static_cast<GLuint>(brickGrid_.voxels.x);
  work.filledAboveY = static_cast<GLuint>(brickGrid_.voxels.y);
  work.filledAboveZ = static_cast<GLuint>(brickGrid_.voxels.z);
  work_.write(0, &work, sizeof(work));
  lost_ = 0;
  bind();
  beginBricks_.set("brickCount", brickCount());
  dispatchFor(*api_, beginBricks_, brickCount());
  // States (compute) are read by the next step.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  boundEmpty();
}

void RunStore::boundEmpty() const {
  bind();
  grid_.apply(beginBounding_);
  beginBounding_.use();
  api_->DispatchCompute(1, 1, 1);
  // The box and its groups (this dispatch) are read by the steps.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
  grid_.apply(boundEmpty_);
  api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, work_.name());
  for (int power = 0; power < MAX_EMPTY_SIDE; ++power) {
    boundEmpty_.set("power", power);
    boundEmpty_.use();
    api_->DispatchComputeIndirect(static_cast<GLintptr>(offsetof(shared::BrickWork, boundGroups) +
                                                        3 * sizeof(GLuint) * static_cast<std::size_t>(power)));
    // States (this step) are read by the next one, by builds and by the trace.
    api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
}

void RunStore::bind() const {
  voxels_.words.bindStorage(SSBO_VOXELS);
  bricks_.bindStorage(SSBO_BRICKS);
  runs_.bindStorage(SSBO_RUNS);
  work_.bindStorage(SSBO_BRICK_WORK);
}

std::uint64_t RunStore::maxCapacity() const {
  // Higher places are states of bricks.
  return std::min<std::uint64_t>(static_cast<std::uint64_t>(api_->limits.storageBlockBytes) / kWordBytes,
                                 BRICK_REQUESTED);
}

bool RunStore::makeRoom(std::uint64_t besides) {
  if (known_.waitingWords == 0) return true;
  // More will be asked for, and each time that the pool grows is a wait; fit() gives back what was too much.
  const std::uint64_t waiting = std::max(known_.waitingWords, known_.longestWaiting);
  const std::uint64_t wanted =
      std::min(maxCapacity(), std::max(times(kGrowth, capacity()), times(kGrowth, known_.usedWords + waiting)));
  if (wanted <= capacity()) {
    lost_ = waiting;
    return false;
  }
  resizePool(wanted, besides);
  const GLuint none[] = {0, 0};
  static_assert(offsetof(shared::BrickWork, longestWaiting) == offsetof(shared::BrickWork, waitingWords) + 4);
  work_.write(offsetof(shared::BrickWork, waitingWords), none, sizeof(none));
  return true;
}

void RunStore::fit(std::uint64_t besides, bool moving) {
  const Headroom& headroom = moving ? kMovingHeadroom : kStillHeadroom;
  const std::uint64_t used = known_.usedWords, left = used - known_.staleWords;
  // The next move will take about as much; there is no more room than is made.
  const std::uint64_t next = moving && used > fitted_ ? std::min(2 * used - fitted_, times(headroom.made, used)) : used;
  const bool unfit =
      capacity() < std::max(times(headroom.least, used), next) || capacity() > times(headroom.most, used);
  if (left == 0) {
    known_ = {};
    known_.fewGroupsY = known_.fewGroupsZ = 1;
    work_.write(0, &known_, sizeof(known_));
    resizePool(0, besides);
  } else if (movable() && (sparse(headroom.made) || (unfit && sparse(kStillHeadroom.made)))) {
    compact(times(headroom.made, left), besides);
  } else if (unfit) {
    resizePool(std::min(maxCapacity(), times(headroom.made, used)), besides);
  }
  fitted_ = known_.usedWords;
}

void RunStore::resizePool(std::uint64_t words, std::uint64_t besides) {
  const std::uint64_t kept = std::min<std::uint64_t>(words, known_.usedWords);
  gl::Buffer pool;
  resize(*api_, pool, words * kWordBytes, "A-buffer runs");
  noteTransient(besides + std::min(runs_.bytes(), pool.bytes()));
  // Runs (shaders) are copied.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  if (kept > 0)
    api_->CopyNamedBufferSubData(runs_.name(), pool.name(), 0, 0, static_cast<GLsizeiptr>(kept * kWordBytes));
  runs_ = std::move(pool);
}

bool RunStore::sparse(double headroom) const {
  const std::uint64_t left = known_.usedWords - known_.staleWords;
  return static_cast<double>(known_.usedWords) > headroom * static_cast<double>(left);
}

bool RunStore::movable() const { return !api_->software || known_.longestRun <= kMaxSoftwareCopy; }

bool RunStore::stuck() const { return sparse(kMovingHeadroom.made) && !movable(); }

void RunStore::compact(std::uint64_t words, std::uint64_t besides) {
  const GLuint left = known_.usedWords - known_.staleWords;
  gl::Buffer together;
  resize(*api_, together, words * kWordBytes, "A-buffer runs");
  noteTransient(besides + std::min(runs_.bytes(), together.bytes()));
  known_.usedWords = 0;  // and counted up
  work_.write(0, &known_, sizeof(known_));
  bind();
  together.bindStorage(SSBO_COMPACTED_RUNS);
  compactRuns_.set("brickCount", brickCount());
  dispatchFor(*api_, compactRuns_, brickCount());
  // Runs and places (this dispatch) are read by the trace; the count is written again.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  runs_ = std::move(together);
  known_.usedWords = left;
  known_.headerWords -= known_.staleHeaderWords;
  known_.staleWords = known_.staleHeaderWords = 0;
  work_.write(0, &known_, sizeof(known_));
}

void RunStore::report(TracerMemory& memory) const {
  memory.grid = grid_.voxels;
  memory.voxels = voxels_.bytes() + bricks_.bytes();
  memory.heads = known_.headerWords * kWordBytes;
  memory.poolReserved = runs_.bytes() - memory.heads;
  memory.fragmentsStored = known_.usedWords - known_.headerWords - (known_.staleWords - known_.staleHeaderWords);
  memory.poolUsed = memory.fragmentsStored * kWordBytes;
  memory.lostFragments = lost_;
  memory.bytesPerFragment = static_cast<double>(kWordBytes);
  memory.structureTotal = memory.voxels + memory.heads + memory.poolReserved + outer_.bytes() + work_.bytes();
  memory.transient = transient_;
}

}  // namespace halfsilver
