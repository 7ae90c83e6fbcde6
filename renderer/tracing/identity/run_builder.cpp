#include "tracing/identity/run_builder.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "scene/vertex_ranges.h"
#include "shared/tracing.h"
#include "tracing/identity/resize.h"
#include "tracing/raster.h"

namespace halfsilver {
namespace {

constexpr std::size_t kBrickBuildBytes = (2 + VOXELS_PER_BRICK) * sizeof(GLuint);  // BrickBuild
constexpr std::size_t kTriangleBlockBytes = 3 * sizeof(GLuint);                    // BoundedBlock
static_assert(SceneExtents::kBlockTriangles == MOVED_BLOCK && MOVED_BLOCK % TRIANGLE_BLOCK == 0);

std::size_t blocksOf(const GpuScene& scene, std::size_t triangles) {
  return (scene.triangleCount + triangles - 1) / triangles;
}

// MovedVertices.
gl::Buffer movedVertices(const gl::Api& api, std::span<const VertexRange> ranges,
                         std::span<const std::uint32_t> blocks) {
  std::vector<GLuint> words = {static_cast<GLuint>(ranges.size()), static_cast<GLuint>(blocks.size())};
  for (const VertexRange& range : ranges) words.insert(words.end(), {range.first, range.first + range.count});
  words.insert(words.end(), blocks.begin(), blocks.end());
  return gl::makeBuffer<GLuint>(api, words, "moved vertices");
}

// BuildStepBlock of tracing/common/projections.glsl.
struct BuildStep {
  GLint secondStep, ownAxis;
  GLint padding[2];  // blocks are multiples of 16 bytes
};

const std::array kBuildDefines{gl::Define{"BUILD_STEP", std::to_string(UBO_BUILD_STEP)}};

}  // namespace

RunBuilder::RunBuilder(const gl::Api& api)
    : api_(&api),
      boundBlocks_(gl::Program::compute(api, "tracing/identity/bound_blocks.comp")),
      beginBuild_(gl::Program::compute(api, "tracing/identity/begin_build.comp")),
      listRequested_(gl::Program::compute(api, "tracing/identity/list_requested.comp")),
      collectBlocks_(gl::Program::compute(api, "tracing/identity/collect_blocks.comp")),
      collectRequested_(gl::Program::compute(api, "tracing/identity/collect_requested.comp")),
      sizeRuns_(gl::Program::compute(api, "tracing/identity/size_runs.comp")),
      placeRuns_(gl::Program::compute(api, "tracing/identity/place_runs.comp")),
      finishBricks_(gl::Program::compute(api, "tracing/identity/finish_bricks.comp")),
      build_(makeVisit(api, "build", kBuildDefines)),
      buildPaired_(gl::Program::compute(api, "tracing/identity/build_paired.comp", kBuildDefines)),
      step_(api, sizeof(BuildStep), "step of a build"),
      counters_(api),
      triangles_(api) {}

RunBuilder::Visit RunBuilder::makeVisit(const gl::Api& api, const std::string& name,
                                        std::span<const gl::Define> defines) {
  const std::string path = "tracing/identity/" + name;
  return {gl::Program::compute(api, path + "_small.comp", defines),
          gl::Program::raster(api, "tracing/common/large_triangles.vert", path + ".frag", defines)};
}

void RunBuilder::measure(const GpuScene& scene, const RunStore& store) {
  resize(*api_, blocks_, blocksOf(scene, TRIANGLE_BLOCK) * kTriangleBlockBytes, "blocks of triangles");
  std::vector<std::uint32_t> all(blocksOf(scene, MOVED_BLOCK));
  std::iota(all.begin(), all.end(), 0u);
  const gl::Buffer vertices = movedVertices(*api_, {}, all);
  vertices.bindStorage(SSBO_MOVED_VERTICES);
  measure(all.size(), scene, store);
}

void RunBuilder::measure(std::size_t blocks, const GpuScene& scene, const RunStore& store) const {
  store.grid().apply(boundBlocks_);
  boundBlocks_.set("triangleCount", scene.triangleCount);
  scene.bindTriangles();
  blocks_.bindStorage(SSBO_TRIANGLE_BLOCKS);
  dispatchFor(*api_, boundBlocks_, blocks * (MOVED_BLOCK / TRIANGLE_BLOCK));
  // Boxes (this dispatch) are read by builds.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void RunBuilder::begin(const GpuScene& scene, const RunStore& store) {
  triangles_.begin(scene, store.ownAxis());
  resize(*api_, brickBuilds_, std::min(kMaxRequests, store.brickCount()) * kBrickBuildBytes, "builds of bricks");
  transient_ = std::max(transient_, bytes());
}

void RunBuilder::buildRequested(const GpuScene& scene, const RunStore& store) {
  store.bind();
  triangles_.bind();
  beginBuild_.set("maxRequests", kMaxRequests);
  beginBuild_.set("brickCount", store.brickCount());
  beginBuild_.set("blockCount", static_cast<GLuint>(blocksOf(scene, TRIANGLE_BLOCK)));
  beginBuild_.use();
  api_->DispatchCompute(1, 1, 1);
  // Arguments and counts (this dispatch) are read by all steps.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);

  listRequested_.set("brickCount", store.brickCount());
  dispatchForBuilds(listRequested_, offsetof(shared::BrickWork, brickGroupsX), store);

  store.grid().apply(collectBlocks_);
  collectBlocks_.set("triangleBlockCount", static_cast<GLuint>(blocksOf(scene, TRIANGLE_BLOCK)));
  blocks_.bindStorage(SSBO_TRIANGLE_BLOCKS);
  dispatchForBuilds(collectBlocks_, offsetof(shared::BrickWork, blockGroupsX), store);
  store.grid().apply(collectRequested_);
  collectRequested_.set("ownAxis", store.ownAxis() ? 1 : 0);
  collectRequested_.set("triangleCount", scene.triangleCount);
  scene.bindTriangles();
  dispatchForBuilds(collectRequested_, offsetof(shared::BrickWork, triangleGroupsX), store);

  visitBuilds(false, scene, store);
  dispatchForBuilds(sizeRuns_, offsetof(shared::BrickWork, buildGroupsX), store);
  dispatchForBuilds(placeRuns_, offsetof(shared::BrickWork, buildGroupsX), store);
  visitBuilds(true, scene, store);
  store.grid().apply(finishBricks_);
  store.entryLayout().apply(finishBricks_);
  finishBricks_.set("triangleCount", scene.triangleCount);
  scene.bindTriangles();
  dispatchForBuilds(finishBricks_, offsetof(shared::BrickWork, groupsPerBuildX), store);
}

void RunBuilder::dispatchForBuilds(const gl::Program& program, std::size_t arguments, const RunStore& store) const {
  store.bind();
  triangles_.bind();
  brickBuilds_.bindStorage(SSBO_BRICK_BUILDS);
  program.use();
  api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, store.work().name());
  api_->DispatchComputeIndirect(static_cast<GLintptr>(arguments));
  // Builds, listed triangles with their arguments, runs and states (this step) are read by the next ones.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void RunBuilder::visitBuilds(bool secondStep, const GpuScene& scene, const RunStore& store) {
  const BuildStep step{secondStep ? 1 : 0, store.ownAxis() ? 1 : 0, {}};
  step_.write(0, &step, sizeof(step));
  step_.bindUniform(UBO_BUILD_STEP);
  for (const gl::Program* program : {&build_.small, &build_.large, &buildPaired_}) store.entryLayout().apply(*program);
  brickBuilds_.bindStorage(SSBO_BRICK_BUILDS);
  visit(build_, store.grid(), scene, store);
  store.grid().apply(buildPaired_);
  dispatchForBuilds(buildPaired_, offsetof(shared::BrickWork, pairGroupsX), store);
}

void RunBuilder::visit(const Visit& programs, const Grid& grid, const GpuScene& scene, const RunStore& store) const {
  for (const gl::Program* program : {&programs.small, &programs.large}) {
    grid.apply(*program);
    program->set("ownAxis", store.ownAxis() ? 1 : 0);
  }
  scene.bindTriangles();
  counters_.bind();
  store.bind();
  triangles_.visit(programs.small, programs.large, grid.longestSide());
  // Marks, counts and entries (the visit) are read by the next steps and the trace.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void RunBuilder::giveUpMoved(const GpuScene& scene, std::span<const VertexRange> moved, const RunStore& store) {
  if (!collectMoved_) {
    collectMoved_ = gl::Program::compute(*api_, "tracing/identity/collect_moved.comp");
    markMoved_ = makeVisit(*api_, "mark_moved");
    giveUpMoved_ = gl::Program::compute(*api_, "tracing/identity/give_up_moved.comp");
  }
  store.bind();
  giveUpMoved_.set("brickCount", store.brickCount());
  dispatchFor(*api_, giveUpMoved_, store.brickCount());
  // States and marks (this dispatch) are changed by the visits.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  const Grid& grid = store.brickGrid();
  grid.apply(collectMoved_);
  collectMoved_.set("ownAxis", store.ownAxis() ? 1 : 0);
  const std::vector<VertexRange> ranges = mergeRanges(moved);
  const std::vector<std::uint32_t> blocks = scene.extents.blocksUsing(ranges);
  const gl::Buffer vertices = movedVertices(*api_, ranges, blocks);
  vertices.bindStorage(SSBO_MOVED_VERTICES);
  measure(blocks.size(), scene, store);
  triangles_.begin(scene, store.ownAxis());
  triangles_.choose(collectMoved_, scene, blocks.size() * MOVED_BLOCK);
  visit(markMoved_, grid, scene, store);
  store.growEmpty();
  transient_ = std::max(transient_, bytes());
}

void RunBuilder::releaseMemory() {
  triangles_.releaseMemory();
  brickBuilds_ = gl::Buffer();
}

void RunBuilder::addMemory(TracerMemory& memory) const {
  memory.structureTotal += counters_.bytes() + blocks_.bytes();
  memory.transient = std::max(memory.transient, transient_);
}

}  // namespace halfsilver
