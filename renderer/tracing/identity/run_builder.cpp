#include "tracing/identity/run_builder.h"

#include <algorithm>

#include "shared/tracing.h"
#include "tracing/identity/resize.h"
#include "tracing/raster.h"

namespace halfsilver {
namespace {

constexpr std::size_t kBrickBuildBytes = (2 + BRICK_SIDE * BRICK_SIDE * BRICK_SIDE) * sizeof(GLuint);  // BrickBuild

}  // namespace

RunBuilder::RunBuilder(const gl::Api& api)
    : api_(&api),
      collectRequested_(gl::Program::compute(api, "tracing/identity/collect_requested.comp")),
      listRequested_(gl::Program::compute(api, "tracing/identity/list_requested.comp")),
      finishBricks_(gl::Program::compute(api, "tracing/identity/finish_bricks.comp")),
      build_(makeVisit(api, "build")),
      placeSum_(api, "tracing/identity/place_runs.comp"),
      counters_(api),
      triangles_(api) {}

RunBuilder::Visit RunBuilder::makeVisit(const gl::Api& api, const std::string& name) {
  const std::string path = "tracing/identity/" + name;
  return {gl::Program::compute(api, path + "_small.comp"),
          gl::Program::raster(api, "tracing/common/large_triangles.vert", path + ".frag")};
}

bool RunBuilder::buildRequested(const GpuScene& scene, RunStore& store) {
  if (!store.complete()) return false;
  const shared::BrickWork requests = store.readWork();
  if (requests.requestedBricks == 0) return true;  // rays that only ran out of iterations

  // Triangles.
  choose(collectRequested_, store.grid(), scene, store);

  const auto setSecondStep = [this](bool second) {
    for (const gl::Program* program : {&build_.small, &build_.large}) program->set("secondStep", second ? 1 : 0);
  };

  // Count.
  const std::uint32_t builds = std::min(requests.requestedBricks, kMaxRequests);
  const std::size_t bytes = builds * kBrickBuildBytes;
  if (brickBuilds_.bytes() < bytes) resize(*api_, brickBuilds_, bytes, "builds of bricks");
  brickBuilds_.fill(0);
  // Builds (clear) are written by the list of requests and added to by the visit.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const auto bindItems = [&] {
    store.bind();
    brickBuilds_.bindStorage(SSBO_BRICK_BUILDS);
  };
  bindItems();
  listRequested_.set("brickCount", store.brickCount());
  dispatchFor(*api_, listRequested_, store.brickCount());
  setSecondStep(false);
  visit(build_, store.grid(), scene, store);

  // Place.
  placeSum_.sum(builds, bindItems);
  const std::uint32_t words = store.readWork().totalWords;
  noteTransient();
  const std::optional<std::uint32_t> place = store.makeRoom(words, this->bytes());
  if (place) {
    placeSum_.placing().set("firstWord", *place);
    placeSum_.place(builds, bindItems);

    // Fill.
    setSecondStep(true);
    visit(build_, store.grid(), scene, store);
    bindItems();
    finishBricks_.set("buildCount", builds);
    dispatchFor(*api_, finishBricks_, builds);
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
  if (!collectMoved_) {
    collectMoved_ = gl::Program::compute(*api_, "tracing/identity/collect_moved.comp");
    markMoved_ = makeVisit(*api_, "mark_moved");
    giveUpMoved_ = gl::Program::compute(*api_, "tracing/identity/give_up_moved.comp");
  }
  store.clearWork();
  store.bind();
  giveUpMoved_.set("brickCount", store.brickCount());
  dispatchFor(*api_, giveUpMoved_, store.brickCount());
  // States and marks (this dispatch) are changed by the visits.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  store.addStale(store.readWork());
  for (const VertexRange& range : moved) {
    store.clearWork();
    collectMoved_.set("firstVertex", static_cast<GLuint>(range.first));
    collectMoved_.set("vertexCount", static_cast<GLuint>(range.count));
    choose(collectMoved_, store.brickGrid(), scene, store);
    noteTransient();
    visit(markMoved_, store.brickGrid(), scene, store);
    store.addStale(store.readWork());
  }
  store.clearWork();
}

void RunBuilder::choose(const gl::Program& program, const Grid& grid, const GpuScene& scene, const RunStore& store) {
  triangles_.begin(scene, store.ownAxis());
  grid.apply(program);
  program.set("ownAxis", store.ownAxis() ? 1 : 0);
  store.bind();
  triangles_.choose(program, scene);
}

void RunBuilder::visit(const Visit& programs, const Grid& grid, const GpuScene& scene, const RunStore& store) const {
  for (const gl::Program* program : {&programs.small, &programs.large}) {
    grid.apply(*program);
    program->set("ownAxis", store.ownAxis() ? 1 : 0);
  }
  scene.bindTriangles();
  counters_.bind();
  if (brickBuilds_) brickBuilds_.bindStorage(SSBO_BRICK_BUILDS);
  store.bind();
  triangles_.visit(programs.small, programs.large, grid.longestSide());
  // Marks, counts and entries (the visit) are read by the sums, the next visit and the trace.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void RunBuilder::releaseMemory() {
  triangles_.releaseMemory();
  brickBuilds_ = gl::Buffer();
}

void RunBuilder::addMemory(TracerMemory& memory) const {
  memory.structureTotal += placeSum_.bytes() + counters_.bytes();
  memory.transient = std::max(memory.transient, transient_);
}

}  // namespace halfsilver
