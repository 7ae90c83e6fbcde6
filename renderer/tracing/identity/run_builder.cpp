#include "tracing/identity/run_builder.h"

#include <algorithm>

#include "shared/tracing.h"
#include "tracing/identity/resize.h"
#include "tracing/raster.h"

namespace halfsilver {
namespace {

constexpr std::size_t kBrickBuildBytes = (1 + BRICK_SIDE * BRICK_SIDE * BRICK_SIDE) * sizeof(GLuint);  // BrickBuild
constexpr int kVerticesPerTriangle = 6;

gl::Program rasterProgram(const gl::Api& api, const char* fragment) {
  return gl::Program::raster(api, "tracing/identity/candidates.vert", fragment);
}

}  // namespace

RunBuilder::RunBuilder(const gl::Api& api)
    : api_(&api),
      collectRequested_(gl::Program::compute(api, "tracing/identity/collect_requested.comp")),
      build_(rasterProgram(api, "tracing/identity/build.frag")),
      finishBricks_(gl::Program::compute(api, "tracing/identity/finish_bricks.comp")),
      placeSum_(api, "tracing/identity/place_runs.comp"),
      vertexArray_(api),
      counters_(api) {}

bool RunBuilder::buildRequested(const GpuScene& scene, RunStore& store) {
  if (!store.complete()) return false;
  const shared::BrickWork requests = store.readWork();
  if (requests.requestedBricks == 0) return true;  // rays that only ran out of iterations

  // Candidates.
  store.grid().apply(collectRequested_);
  collect(collectRequested_, scene, store);

  // Count.
  const std::size_t bytes = std::min(requests.requestedBricks, kMaxRequests) * kBrickBuildBytes;
  if (brickBuilds_.bytes() < bytes) resize(*api_, brickBuilds_, bytes, "builds of bricks");
  brickBuilds_.fill(0);
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);  // counts (clear) are added to by fragments
  build_.set("secondStep", 0);
  rasterize(build_, store.grid(), scene, store);

  // Place.
  const auto bindItems = [&] {
    store.bind();
    brickBuilds_.bindStorage(SSBO_BRICK_BUILDS);
  };
  placeSum_.sum(store.brickCount(), bindItems);
  const std::uint32_t words = store.readWork().totalWords;
  noteTransient();
  const std::optional<std::uint32_t> place = store.makeRoom(words, this->bytes());
  if (place) {
    placeSum_.placing().set("firstWord", *place);
    placeSum_.place(store.brickCount(), bindItems);

    // Fill.
    build_.set("secondStep", 1);
    rasterize(build_, store.grid(), scene, store);
    bindItems();
    finishBricks_.set("brickCount", store.brickCount());
    dispatchFor(*api_, finishBricks_, store.brickCount());
    store.addBuilt(store.readWork());
  } else {
    store.addLost(words);
  }
  store.clearWork();
  // Clears and states come before the next requests.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  return place.has_value();
}

void RunBuilder::giveUpMoved(const GpuScene& scene, std::span<const VertexRange> moved, RunStore& store) {
  if (!markMoved_) {
    collectMoved_ = gl::Program::compute(*api_, "tracing/identity/collect_moved.comp");
    markMoved_ = rasterProgram(*api_, "tracing/identity/mark_moved.frag");
    giveUpMoved_ = gl::Program::compute(*api_, "tracing/identity/give_up_moved.comp");
  }
  store.clearWork();
  store.bind();
  giveUpMoved_.set("brickCount", store.brickCount());
  dispatchFor(*api_, giveUpMoved_, store.brickCount());
  // States and marks (compute) are changed by fragments.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  store.addStale(store.readWork());
  for (const VertexRange& range : moved) {
    store.clearWork();
    collectMoved_.set("firstVertex", static_cast<GLuint>(range.first));
    collectMoved_.set("vertexCount", static_cast<GLuint>(range.count));
    collect(collectMoved_, scene, store);
    noteTransient();
    rasterize(markMoved_, store.brickGrid(), scene, store);
    store.addStale(store.readWork());
  }
  store.clearWork();
}

void RunBuilder::collect(const gl::Program& program, const GpuScene& scene, const RunStore& store) {
  resize(*api_, candidates_, scene.triangleCount * sizeof(GLuint), "candidates of a build");
  program.set("triangleCount", scene.triangleCount);
  program.set("verticesPerTriangle", kVerticesPerTriangle);
  scene.bindTriangles();
  candidates_.bindStorage(SSBO_CANDIDATES);
  store.bind();
  dispatchFor(*api_, program, scene.triangleCount);
  // Candidates and the draw's arguments (collection) are read by the draws.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void RunBuilder::rasterize(const gl::Program& program, const Grid& raster, const GpuScene& scene,
                           const RunStore& store) {
  raster.apply(program);
  program.set("ownAxis", store.ownAxis() ? 1 : 0);
  program.set("rasterResolution", raster.longestSide());
  scene.bindTriangles();
  counters_.bind();
  if (brickBuilds_) brickBuilds_.bindStorage(SSBO_BRICK_BUILDS);
  candidates_.bindStorage(SSBO_CANDIDATES);
  store.bind();
  rasterizeScene(*api_, program, vertexArray_, scene,
                 {.resolution = raster.longestSide(), .projections = 1, .verticesPerTriangle = kVerticesPerTriangle},
                 &store.work());
  // Marks, counts and entries (fragments) are read by the sums, the next draw and the trace.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void RunBuilder::releaseMemory() {
  candidates_ = gl::Buffer();
  brickBuilds_ = gl::Buffer();
}

void RunBuilder::addMemory(TracerMemory& memory) const {
  memory.structureTotal += placeSum_.bytes() + counters_.bytes();
  memory.transient = std::max(memory.transient, transient_);
}

}  // namespace halfsilver
