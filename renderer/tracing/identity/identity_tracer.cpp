#include "tracing/identity/identity_tracer.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include <halfsilver/shared_structs.h>
#include "shared/tracing.h"
#include "tracing/raster.h"

namespace halfsilver {
namespace {

constexpr std::uint64_t kWordBytes = 4;
constexpr std::size_t kBrickBuildWords = 1 + BRICK_SIDE * BRICK_SIDE * BRICK_SIDE;  // BrickBuild
constexpr int kVerticesPerTriangle = 6;

// Bricks on a waiting ray's way that are built with the one it waits for; doubled each time that rays wait again. Few
// and many small builds, or fewer builds of lists that nobody needs.
constexpr int kFirstLookAhead = 2;
constexpr int kKeptLookAhead = 16;  // where most bricks are there from earlier frames: another build costs more
constexpr int kMostLookAhead = 4096;
// Bricks that one dispatch may ask for: 65 words each while they are built (8.5 MB).
constexpr std::uint32_t kMostRequests = 32768;
// Software rasterizers stop long loops; an invocation copies a run.
constexpr std::uint64_t kLongestSoftwareCopy = 8000;
// Room beyond what is needed where a pool grows that already holds lists: the next frame will want a little more.
constexpr double kHeadroom = 1.03;

gl::Program rasterProgram(const gl::Api& api, bool move) {
  std::vector<gl::Define> defines;
  if (move) defines.push_back({"MOVE"});
  return gl::Program::raster(api, "tracing/identity_build.vert", "tracing/identity_build.frag", defines);
}

gl::Program statesProgram(const gl::Api& api, const char* step) {
  const gl::Define defines[] = {{step}};
  return gl::Program::compute(api, "tracing/brick_states.comp", defines);
}

TracePass makeTracePass(const gl::Api& api, const Settings& settings) {
  const gl::Define defines[] = {{"METHOD_IDENTITY"}};
  return TracePass(api, settings.trace.stage, defines);
}

// Buffers of the size that is wanted now; an empty one cannot be bound.
void resize(const gl::Api& api, gl::Buffer& buffer, std::size_t bytes, const char* label) {
  bytes = std::max<std::size_t>(bytes, sizeof(glm::uvec4));
  if (buffer.bytes() == bytes) return;
  buffer = gl::Buffer();  // the old one goes first: both at once might not fit
  buffer = gl::Buffer(api, bytes, label);
}

}  // namespace

Method IdentityTracer::method() {
  return {{.name = "identity",
           .help = "fragments that name their triangle, exact ray/triangle test",
           .settings = {"voxels.resolution", "voxels.per_triangle", "voxels.axis", "abuffer.keep", "trace.stage"},
           .preset = "halfsilver",
           .knobs = {{"voxels.per_triangle", {"2", "4", "8", "16", "32", "64"}}}},
          [](const gl::Api& api, const Settings& settings) { return std::make_unique<IdentityTracer>(api, settings); }};
}

// Only conservative voxels hold every triangle, so the other rasters of VoxelRaster are not offered here.
IdentityTracer::IdentityTracer(const gl::Api& api, const Settings& settings)
    : api_(&api),
      resolution_(settings.voxels.resolution),
      perTriangle_(static_cast<double>(settings.identity.voxelsPerTriangle)),
      ownAxis_(settings.voxels.axis == AxisRule::own),
      keep_(settings.identity.keep),
      voxelPass_(api, VoxelRaster::conservative, settings.voxels.axis),
      placeSum_(api, "RUNS"),
      setStates_(statesProgram(api, "BEGIN")),
      cull_(gl::Program::compute(api, "tracing/identity_cull.comp")),
      build_(rasterProgram(api, false)),
      finish_(statesProgram(api, "FINISH")),
      tracePass_(makeTracePass(api, settings)),
      vertexArray_(api),
      counters_(api) {}

void IdentityTracer::update(const FrameView& view, const SceneChange& change) {
  const GpuScene& scene = view.scene;
  transient_ = 0;
  const bool kept = keep_ && built_ && lost_ == 0 && !change.topology;  // a pool that overflowed starts over
  firstLookAhead_ = kKeptLookAhead;
  if (kept && change.moved.empty()) return;
  constexpr double kVoxels = BRICK_SIDE * BRICK_SIDE * BRICK_SIDE;
  const double voxels = perTriangle_ * static_cast<double>(scene.triangleCount);
  const double wanted = perTriangle_ > 0 ? std::max(1.0, voxels / kVoxels) : 0.0;
  const Grid bricks = makeCubicGrid(scene.core.bounds, std::max(1, resolution_ / BRICK_SIDE), wanted);
  const bool follows = kept && ownAxis_ && bricks == brickGrid_;
  std::vector<GLuint> outer = {static_cast<GLuint>(scene.core.outer.size())};
  outer.insert(outer.end(), scene.core.outer.begin(), scene.core.outer.end());
  outer_ = gl::makeBuffer(*api_, std::span<const GLuint>(outer), "triangles beyond the grid");
  built_ = false;  // until nothing has failed
  grid_ = brickGrid_ = bricks;
  grid_.voxels *= BRICK_SIDE;
  if (!follows) voxelPass_.run(view, brickGrid_, voxels_);
  const auto scope = view.profiler.section("voxelize");
  if (follows) {
    followMove(scene, change.moved);
  } else {
    forgetBricks();
    firstLookAhead_ = kFirstLookAhead;
  }
  built_ = true;
}

// Lists may name triangles that have gone: the exact test sees where they are now. So only bricks that moved triangles
// have come to must be built anew, once a ray asks; those that they came to at the last move are given up, too, so that
// lists do not grow along an object's path.
void IdentityTracer::followMove(const GpuScene& scene, std::span<const VertexRange> moved) {
  if (!move_) {
    const gl::Define defines[] = {{"MOVED"}};
    collectMoved_ = gl::Program::compute(*api_, "tracing/identity_cull.comp", defines);
    move_ = rasterProgram(*api_, true);
    leave_ = statesProgram(*api_, "LEAVE");
    compactSum_.emplace(*api_, "COMPACT");
  }
  resize(*api_, candidates_, scene.triangleCount * sizeof(GLuint), "candidates of a build");
  noteTransient(0);
  const auto noteStale = [&] {
    shared::ListBuild state{};
    api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);  // counts (shaders) are read by the host
    listBuild_.read(0, &state, sizeof(state));
    stale_ += state.stale;
    staleHeaders_ += state.staleHeaders;
  };
  clearListBuild();
  bindStructure();
  leave_.set("brickCount", brickCount());
  dispatchFor(*api_, leave_, brickCount());
  // States and marks (compute) are changed by fragments.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  noteStale();
  for (const VertexRange& range : moved) {
    clearListBuild();
    candidates_.bindStorage(SSBO_LINKS);
    listBuild_.bindStorage(SSBO_LIST_BUILD);
    collectMoved_.set("firstVertex", static_cast<GLuint>(range.first));
    collectMoved_.set("vertexCount", static_cast<GLuint>(range.count));
    collect(collectMoved_, scene);
    rasterizeCandidates(move_, brickGrid_, scene);
    noteStale();
  }
  clearListBuild();
  // Runs that were given up leave their words behind.
  if (static_cast<double>(used_) <= kHeadroom * static_cast<double>(used_ - stale_)) return;
  if (api_->software && longest_ > kLongestSoftwareCopy)
    forgetBricks();
  else
    compact();
}

void IdentityTracer::compact() {
  const std::uint64_t wanted =
      std::min(capacity(), static_cast<std::uint64_t>(kHeadroom * static_cast<double>(used_ - stale_)) + 4);
  gl::Buffer together(*api_, wanted * kWordBytes, "A-buffer runs");
  noteTransient(runs_.bytes());
  bindStructure();
  together.bindStorage(SSBO_MOVED_RUNS);
  compactSum_->sum(brickCount());
  compactSum_->place(brickCount());
  runs_ = std::move(together);
  used_ -= stale_;
  headers_ -= staleHeaders_;
  stale_ = staleHeaders_ = 0;
}

void IdentityTracer::clearListBuild() {
  shared::ListBuild none{};
  none.instanceCount = ownAxis_ ? 1 : 3;
  listBuild_.write(0, &none, sizeof(none));
}

void IdentityTracer::collect(const gl::Program& program, const GpuScene& scene) {
  scene.bindTriangles();
  program.set("triangleCount", scene.triangleCount);
  program.set("verticesPerTriangle", kVerticesPerTriangle);
  dispatchFor(*api_, program, scene.triangleCount);
  // Candidates and the draw's arguments (collection) are read by the draws.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void IdentityTracer::forgetBricks() {
  resize(*api_, bricks_, brickCount() * sizeof(GLuint), "A-buffer bricks");
  resize(*api_, listBuild_, sizeof(shared::ListBuild), "build of lists");
  if (!runs_) resize(*api_, runs_, 0, "A-buffer runs");
  clearListBuild();
  counters_.clear();
  bindStructure();
  setStates_.set("brickCount", brickCount());
  dispatchFor(*api_, setStates_, brickCount());
  used_ = headers_ = stale_ = staleHeaders_ = longest_ = lost_ = 0;
  // States (compute, clears) are read and written by the trace.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}

void IdentityTracer::bindStructure() const {
  voxels_.words.bindStorage(SSBO_VOXELS);
  bricks_.bindStorage(SSBO_HEADS);
  runs_.bindStorage(SSBO_ENTRIES);
  listBuild_.bindStorage(SSBO_LIST_BUILD);
}

void IdentityTracer::trace(const FrameView& view, const RayQueue& rays, Hits& hits) {
  const gl::Program& program = tracePass_.program();
  grid_.apply(program);
  int lookAhead = firstLookAhead_;
  program.set("lookAhead", lookAhead);
  program.set("mostRequests", kMostRequests);
  bindStructure();
  outer_.bindStorage(SSBO_OUTER);
  tracePass_.run(view, rays, hits, [&] {
    const auto scope = view.profiler.section("build");
    lookAhead = std::min(2 * lookAhead, kMostLookAhead);
    program.set("lookAhead", lookAhead);
    const bool more = buildRequested(view.scene);
    bindStructure();
    outer_.bindStorage(SSBO_OUTER);
    return more;
  });
  if (used_ == 0) resize(*api_, runs_, 0, "A-buffer runs");  // what an earlier geometry needed
  candidates_ = gl::Buffer();
  brickBuilds_ = gl::Buffer();
}

bool IdentityTracer::buildRequested(const GpuScene& scene) {
  if (lost_ > 0) return false;
  shared::ListBuild state{};
  listBuild_.read(0, &state, sizeof(state));
  if (state.requested == 0) return true;  // rays that only ran out of iterations

  resize(*api_, candidates_, scene.triangleCount * sizeof(GLuint), "candidates of a build");
  candidates_.bindStorage(SSBO_LINKS);
  grid_.apply(cull_);
  collect(cull_, scene);
  const std::size_t bytes = std::min(state.requested, kMostRequests) * kBrickBuildWords * kWordBytes;
  if (brickBuilds_.bytes() < bytes) resize(*api_, brickBuilds_, bytes, "builds of bricks");
  brickBuilds_.fill(0);
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);  // counts (clear) are added to by fragments
  brickBuilds_.bindStorage(SSBO_BRICK_BUILDS);
  build_.set("secondStep", 0);
  rasterizeCandidates(build_, grid_, scene);
  placeSum_.sum(brickCount());
  listBuild_.read(0, &state, sizeof(state));
  noteTransient(0);
  const bool room = makeRoom(state.total);
  if (room) {
    runs_.bindStorage(SSBO_ENTRIES);
    placeSum_.placing().set("firstWord", static_cast<GLuint>(used_));
    placeSum_.place(brickCount());
    build_.set("secondStep", 1);
    rasterizeCandidates(build_, grid_, scene);
    finish_.set("brickCount", brickCount());
    dispatchFor(*api_, finish_, brickCount());
    api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);  // counts (sums) are read by the host
    listBuild_.read(0, &state, sizeof(state));
    used_ += state.total;
    headers_ += state.headers;
    longest_ = std::max<std::uint64_t>(longest_, state.longest);
  } else {
    lost_ += state.total;  // the bricks stay requested
  }
  clearListBuild();
  // Clears and states come before the next requests.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  return room;
}

void IdentityTracer::rasterizeCandidates(const gl::Program& program, const Grid& raster, const GpuScene& scene) {
  bindStructure();
  candidates_.bindStorage(SSBO_LINKS);
  counters_.bind();
  raster.apply(program);
  program.set("ownAxis", ownAxis_ ? 1 : 0);
  program.set("rasterResolution", raster.longestSide());
  rasterizeScene(*api_, program, vertexArray_, scene,
                 {.resolution = raster.longestSide(), .projections = 1, .verticesPerTriangle = kVerticesPerTriangle},
                 &listBuild_);
  // Marks, counts and entries (fragments) are read by the sums, the next draw and the trace.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

bool IdentityTracer::makeRoom(std::uint64_t more) {
  const std::uint64_t needed = used_ + more;
  // Higher places are states of bricks.
  const std::uint64_t most =
      std::min<std::uint64_t>(static_cast<std::uint64_t>(api_->limits.storageBlockBytes) / kWordBytes, BRICK_REQUESTED);
  if (needed > most) return false;
  // A pool of an earlier geometry that is much too large goes, too.
  if (needed <= capacity() && (used_ > 0 || static_cast<double>(capacity()) <= kHeadroom * static_cast<double>(needed)))
    return true;
  if (used_ == 0) {
    resize(*api_, runs_, needed * kWordBytes, "A-buffer runs");
    return true;
  }
  const auto wanted = std::min(most, static_cast<std::uint64_t>(kHeadroom * static_cast<double>(needed)));
  gl::Buffer larger(*api_, wanted * kWordBytes, "A-buffer runs");
  noteTransient(runs_.bytes());
  // Runs (fragments) are copied.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  api_->CopyNamedBufferSubData(runs_.name(), larger.name(), 0, 0, static_cast<GLsizeiptr>(used_ * kWordBytes));
  runs_ = std::move(larger);
  return true;
}

std::uint64_t IdentityTracer::capacity() const { return runs_.bytes() / kWordBytes; }

// `more`: bytes besides what is kept and what a build needs.
void IdentityTracer::noteTransient(std::uint64_t more) {
  transient_ = std::max<std::uint64_t>(transient_, candidates_.bytes() + brickBuilds_.bytes() + more);
}

TracerMemory IdentityTracer::memory() const {
  TracerMemory memory;
  memory.grid = grid_.voxels;
  memory.voxels = voxels_.bytes() + bricks_.bytes();
  memory.heads = headers_ * kWordBytes;
  memory.poolReserved = runs_.bytes() - memory.heads;
  memory.fragmentsStored = used_ - headers_ - (stale_ - staleHeaders_);
  memory.poolUsed = memory.fragmentsStored * kWordBytes;
  memory.lostFragments = lost_;
  memory.bytesPerFragment = static_cast<double>(kWordBytes);
  memory.structureTotal = memory.voxels + memory.heads + memory.poolReserved + outer_.bytes() + listBuild_.bytes() +
                          placeSum_.bytes() + counters_.bytes();
  if (compactSum_) memory.structureTotal += compactSum_->bytes();
  memory.transient = transient_;
  return memory;
}

}  // namespace halfsilver
