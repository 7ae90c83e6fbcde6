#include "tracing/identity/identity_tracer.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "frame/shared_structs.h"
#include "shared/tracing.h"
#include "tracing/raster.h"

namespace halfsilver {
namespace {

constexpr std::uint64_t kEntryBytes = 4;
constexpr int kVerticesPerTriangle = 6;

// Occupied voxels on a waiting ray's way that are built with the one it waits for; doubled each time that rays wait
// again. Few and many small builds, or fewer builds of lists that nobody needs.
constexpr int kFirstLookAhead = 8;
constexpr int kMostLookAhead = 4096;
// Software rasterizers stop long loops: an invocation copies SUM_ITEMS lists.
constexpr std::uint32_t kLongestSoftwareCopy = 400;
// Room beyond what is needed where a pool grows that already holds lists: the next frame will want a little more.
constexpr double kHeadroom = 1.05;

gl::Program rasterProgram(const gl::Api& api, bool move) {
  std::vector<gl::Define> defines;
  if (move) defines.push_back({"MOVE"});
  return gl::Program::raster(api, "tracing/identity_build.vert", "tracing/identity_build.frag", defines);
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

// Only conservative voxels hold every triangle, so the other rasters of VoxelRaster are not offered here.
IdentityTracer::IdentityTracer(const gl::Api& api, const Settings& settings)
    : api_(&api),
      resolution_(settings.voxels.resolution),
      perTriangle_(static_cast<double>(settings.voxels.perTriangle)),
      ownAxis_(settings.voxels.axis == AxisRule::own),
      keep_(settings.abuffer.keep),
      voxelPass_(api, VoxelRaster::conservative, settings.voxels.axis),
      rankSum_(api, "RANKS"),
      placeSum_(api, "LISTS"),
      cull_(gl::Program::compute(api, "tracing/identity_cull.comp")),
      build_(rasterProgram(api, false)),
      tracePass_(makeTracePass(api, settings)),
      vertexArray_(api),
      counters_(api) {}

void IdentityTracer::build(const GpuScene& scene, const RayQueue&, gl::Profiler& profiler) {
  if (lost_ > 0) geometry_.reset();  // a full pool begins anew
  if (keep_ && geometry_ == scene.geometry) return;
  const Grid grid = makeCubicGrid(scene.bounds, resolution_, perTriangle_ * static_cast<double>(scene.triangleCount));
  const bool follows = keep_ && ownAxis_ && geometry_ && *geometry_ + 1 == scene.geometry && grid == grid_;
  geometry_.reset();
  grid_ = grid;
  if (!follows) voxelPass_.run(scene, grid_, voxels_, profiler);
  const auto scope = profiler.section("voxelize");
  if (follows)
    followMove(scene);
  else
    numberLists();
  geometry_ = scene.geometry;
}

// Lists may name triangles that have gone: the exact test sees where they are now. So only voxels that moved triangles
// have come to matter: they are occupied, and their lists are built anew once a ray asks.
void IdentityTracer::followMove(const GpuScene& scene) {
  if (!move_) {
    const gl::Define moved[] = {{"MOVED"}};
    collectMoved_ = gl::Program::compute(*api_, "tracing/identity_cull.comp", moved);
    move_ = rasterProgram(*api_, true);
    renumber_ = gl::Program::compute(*api_, "tracing/identity_renumber.comp");
    compactSum_.emplace(*api_, "COMPACT");
  }
  resize(*api_, candidates_, scene.triangleCount * sizeof(GLuint), "candidates of a build");
  for (const VertexRange& range : scene.moved) {
    clearListBuild();
    candidates_.bindStorage(SSBO_LINKS);
    listBuild_.bindStorage(SSBO_LIST_BUILD);
    collectMoved_.set("firstVertex", static_cast<GLuint>(range.first));
    collectMoved_.set("vertexCount", static_cast<GLuint>(range.count));
    collect(collectMoved_, scene);
    const gl::Buffer oldWords = copyOf(voxels_.words);
    rasterizeCandidates(move_, 0, scene);
    renumber(oldWords);
    rasterizeCandidates(move_, 1, scene);
    std::uint32_t stale = 0;
    api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);  // counts (fragments) are read by the host
    listBuild_.read(offsetof(shared::ListBuild, stale), &stale, sizeof(stale));
    stale_ += stale;
  }
  clearListBuild();
  // Lists that were given up leave their entries behind.
  if (static_cast<double>(used_) <= kHeadroom * static_cast<double>(used_ - stale_)) return;
  const bool loopsEnd = api_->software && longest_ > kLongestSoftwareCopy;
  if (loopsEnd)
    numberLists();
  else
    compact();
}

void IdentityTracer::compact() {
  const std::uint64_t wanted =
      std::min(capacity(), static_cast<std::uint64_t>(kHeadroom * static_cast<double>(used_ - stale_)) + 4);
  gl::Buffer together(*api_, wanted * kEntryBytes, "A-buffer entries");
  bindStructure();
  together.bindStorage(SSBO_MOVED_ENTRIES);
  compactSum_->sum(lists_);
  compactSum_->place(lists_);
  entries_ = std::move(together);
  used_ -= stale_;
  stale_ = 0;
}

gl::Buffer IdentityTracer::copyOf(const gl::Buffer& buffer) const {
  gl::Buffer copy(*api_, buffer.bytes(), "copy");
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);  // what shaders wrote is copied
  api_->CopyNamedBufferSubData(buffer.name(), copy.name(), 0, 0, static_cast<GLsizeiptr>(buffer.bytes()));
  return copy;
}

// After voxels have become occupied: the lists behind them get higher numbers.
void IdentityTracer::renumber(const gl::Buffer& oldWords) {
  const auto words = static_cast<std::uint32_t>(voxels_.words.bytes() / sizeof(GLuint));
  const gl::Buffer oldRanks = copyOf(ranks_);
  bindStructure();
  rankSum_.sum(words);
  std::uint32_t lists = 0;
  listBuild_.read(offsetof(shared::ListBuild, total), &lists, sizeof(lists));
  if (lists == lists_) return;
  rankSum_.place(words);
  const gl::Buffer oldHeads = std::move(heads_);
  heads_ = gl::Buffer(*api_, lists * 2 * sizeof(GLuint), "A-buffer heads");
  lists_ = lists;
  bindStructure();
  oldWords.bindStorage(SSBO_OLD_VOXELS);
  oldRanks.bindStorage(SSBO_OLD_RANKS);
  oldHeads.bindStorage(SSBO_OLD_HEADS);
  renumber_.set("wordCount", words);
  dispatchFor(*api_, renumber_, words);
  // Heads (renumbering) are written by fragments and read by the trace.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void IdentityTracer::clearListBuild() {
  const shared::ListBuild none{0, ownAxis_ ? 1u : 3u, 0, 0, 0, 0, 0, 0};
  listBuild_.write(0, &none, sizeof(none));
}

void IdentityTracer::collect(const gl::Program& program, const GpuScene& scene) {
  program.set("triangleCount", scene.triangleCount);
  program.set("verticesPerTriangle", kVerticesPerTriangle);
  dispatchFor(*api_, program, scene.triangleCount);
  // Candidates and the draw's arguments (collection) are read by the draws.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void IdentityTracer::numberLists() {
  const auto words = static_cast<std::uint32_t>(voxels_.words.bytes() / sizeof(GLuint));
  resize(*api_, ranks_, words * sizeof(GLuint), "numbers of lists");
  resize(*api_, listBuild_, sizeof(shared::ListBuild), "build of lists");
  resize(*api_, requested_, (grid_.voxelCount() + 31) / 32 * sizeof(GLuint), "requested voxels");
  clearListBuild();
  requested_.fill(0);
  counters_.clear();
  voxels_.words.bindStorage(SSBO_VOXELS);
  ranks_.bindStorage(SSBO_RANKS);
  listBuild_.bindStorage(SSBO_LIST_BUILD);
  // Clears come before the sums.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  rankSum_.sum(words);
  rankSum_.place(words);
  listBuild_.read(offsetof(shared::ListBuild, total), &lists_, sizeof(lists_));
  resize(*api_, heads_, lists_ * 2 * sizeof(GLuint), "A-buffer heads");
  heads_.fill(LIST_MISSING);
  used_ = stale_ = lost_ = 0;
  longest_ = 0;
  if (!entries_) resize(*api_, entries_, 0, "A-buffer entries");
  // Heads (clear) are read and written by the trace.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}

void IdentityTracer::bindStructure() const {
  voxels_.words.bindStorage(SSBO_VOXELS);
  ranks_.bindStorage(SSBO_RANKS);
  heads_.bindStorage(SSBO_HEADS);
  entries_.bindStorage(SSBO_ENTRIES);
  requested_.bindStorage(SSBO_REQUESTED);
  listBuild_.bindStorage(SSBO_LIST_BUILD);
}

void IdentityTracer::trace(const GpuScene& scene, const RayQueue& rays, Hits& hits, gl::Profiler& profiler) {
  const gl::Program& program = tracePass_.program();
  grid_.apply(program);
  int lookAhead = kFirstLookAhead;
  program.set("lookAhead", lookAhead);
  bindStructure();
  tracePass_.run(rays, hits, profiler, [&] {
    const auto scope = profiler.section("build");
    lookAhead = std::min(2 * lookAhead, kMostLookAhead);
    program.set("lookAhead", lookAhead);
    const bool more = buildRequested(scene);
    bindStructure();
    return more;
  });
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
  rasterizeCandidates(build_, 0, scene);
  placeSum_.sum(lists_);
  listBuild_.read(0, &state, sizeof(state));
  longest_ = std::max(longest_, state.longest);
  const bool room = makeRoom(state.total);
  if (room) {
    placeSum_.placing().set("firstEntry", static_cast<GLuint>(used_));
    placeSum_.place(lists_);
    rasterizeCandidates(build_, 1, scene);
    used_ += state.total;
  } else {
    lost_ += state.total;  // the lists stay requested and missing
  }
  clearListBuild();
  requested_.fill(0);
  // Clears come before the next requests.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  return room;
}

void IdentityTracer::rasterizeCandidates(const gl::Program& program, int step, const GpuScene& scene) {
  bindStructure();
  candidates_.bindStorage(SSBO_LINKS);
  counters_.bind();
  grid_.apply(program);
  program.set("ownAxis", ownAxis_ ? 1 : 0);
  program.set("secondStep", step);
  program.set("rasterResolution", grid_.longestSide());
  rasterizeScene(*api_, program, vertexArray_, scene,
                 {.resolution = grid_.longestSide(), .projections = 1, .verticesPerTriangle = kVerticesPerTriangle},
                 &listBuild_);
  // Marks, counts, entries and ends of lists (fragments) are read by the sums, the next draw and the trace.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

bool IdentityTracer::makeRoom(std::uint64_t more) {
  const std::uint64_t needed = used_ + more;
  const std::uint64_t most = static_cast<std::uint64_t>(api_->limits.storageBlockBytes) / kEntryBytes;
  if (needed > most) return false;
  // A pool of an earlier geometry that is much too large goes, too.
  if (needed <= capacity() && (used_ > 0 || static_cast<double>(capacity()) <= kHeadroom * static_cast<double>(needed)))
    return true;
  if (used_ == 0) {
    resize(*api_, entries_, needed * kEntryBytes, "A-buffer entries");
    return true;
  }
  const auto wanted = std::min(most, static_cast<std::uint64_t>(kHeadroom * static_cast<double>(needed)));
  gl::Buffer larger(*api_, wanted * kEntryBytes, "A-buffer entries");
  // Entries (fragments) are copied.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  api_->CopyNamedBufferSubData(entries_.name(), larger.name(), 0, 0, static_cast<GLsizeiptr>(used_ * kEntryBytes));
  entries_ = std::move(larger);
  return true;
}

std::uint64_t IdentityTracer::capacity() const { return entries_.bytes() / kEntryBytes; }

TracerMemory IdentityTracer::memory() const {
  TracerMemory memory;
  memory.voxels = voxels_.bytes() + ranks_.bytes() + requested_.bytes();
  memory.heads = heads_.bytes();
  memory.grid = grid_.voxels;
  memory.poolReserved = entries_.bytes();
  memory.poolUsed = (used_ - stale_) * kEntryBytes;
  memory.fragmentsStored = used_ - stale_;
  // These add up over all builds since everything began anew.
  memory.fragments = counters_.sum(COUNTER_FRAGMENTS);
  for (std::uint32_t axis = 0; axis < 3; ++axis) memory.perAxis[axis] = counters_.sum(COUNTER_STORED_X + axis);
  memory.bytesPerFragment = static_cast<double>(kEntryBytes);
  memory.structureTotal = memory.voxels + memory.heads + memory.poolReserved + candidates_.bytes() +
                          listBuild_.bytes() + rankSum_.bytes() + placeSum_.bytes() + counters_.bytes();
  if (compactSum_) memory.structureTotal += compactSum_->bytes();
  return memory;
}

}  // namespace halfsilver
