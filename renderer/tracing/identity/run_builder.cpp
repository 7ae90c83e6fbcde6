#include "tracing/identity/run_builder.h"

#include <algorithm>
#include <array>
#include <vector>

#include "scene/vertex_ranges.h"
#include "shared/tracing.h"
#include "tracing/raster.h"
#include "tracing/resize.h"

namespace halfsilver {
namespace {

constexpr std::size_t kRequestBytes = 2 * sizeof(GLuint);                    // BrickRequest
constexpr std::size_t kBrickBuildBytes = VOXELS_PER_BRICK * sizeof(GLuint);  // BrickBuild
constexpr std::size_t kTriangleBlockBytes = 3 * sizeof(GLuint);              // BoundedBlock
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
      clearBuilds_(gl::Program::compute(api, "tracing/identity/clear_builds.comp")),
      collectBlocks_(gl::Program::compute(api, "tracing/identity/collect_blocks.comp")),
      collectRequested_(gl::Program::compute(api, "tracing/identity/collect_requested.comp")),
      sizeRuns_(gl::Program::compute(api, "tracing/identity/size_runs.comp")),
      placeRuns_(gl::Program::compute(api, "tracing/identity/place_runs.comp")),
      finishBricks_(gl::Program::compute(api, "tracing/identity/finish_bricks.comp")),
      buildFew_(gl::Program::compute(api, "tracing/identity/build_few.comp")),
      buildSmall_(gl::Program::compute(api, "tracing/identity/build_small.comp", kBuildDefines)),
      buildLarge_(gl::Program::raster(api, "tracing/common/large_triangles.vert", "tracing/identity/build.frag",
                                      kBuildDefines)),
      buildPaired_(gl::Program::compute(api, "tracing/identity/build_paired.comp", kBuildDefines)),
      step_(api, sizeof(BuildStep), "step of a build"),
      counters_(api),
      triangles_(api) {}

void RunBuilder::measure(const GpuScene& scene, const RunStore& store) {
  const std::size_t blocks = blocksOf(scene, TRIANGLE_BLOCK);
  resize(*api_, blocks_, blocks * kTriangleBlockBytes, "blocks of triangles");
  store.grid().apply(boundBlocks_);
  boundBlocks_.set("triangleCount", scene.triangleCount);
  scene.bindTriangles();
  blocks_.bindStorage(SSBO_TRIANGLE_BLOCKS);
  dispatchFor(*api_, boundBlocks_, blocks);
  // Boxes (this dispatch) are read by builds.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void RunBuilder::begin(const RunStore& store) {
  resize(*api_, requests_, std::min(kMaxRequests, store.brickCount()) * kRequestBytes, "requests of bricks");
  transient_ = std::max(transient_, bytes());
}

void RunBuilder::buildFew(const GpuScene& scene, const RunStore& store) const {
  store.grid().apply(buildFew_);
  store.entryLayout().apply(buildFew_);
  buildFew_.set("ownAxis", store.ownAxis() ? 1 : 0);
  buildFew_.set("triangleCount", scene.triangleCount);
  buildFew_.set("triangleBlockCount", static_cast<GLuint>(blocksOf(scene, TRIANGLE_BLOCK)));
  store.bind();
  scene.bindTriangles();
  counters_.bind();
  blocks_.bindStorage(SSBO_TRIANGLE_BLOCKS);
  bindRequests();
  buildFew_.use();
  api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, store.work().name());
  api_->DispatchComputeIndirect(offsetof(shared::BrickWork, fewGroupsX));
  // Runs, states and arguments (this dispatch) are read by the trace and by the next build.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void RunBuilder::reserve(const GpuScene& scene, const RunStore& store) {
  if (brickBuilds_) return;
  triangles_.begin(scene, store.ownAxis());
  resize(*api_, brickBuilds_, std::min(kMaxRequests, store.brickCount()) * kBrickBuildBytes, "builds of bricks");
  transient_ = std::max(transient_, bytes());
}

void RunBuilder::buildRequested(const GpuScene& scene, const RunStore& store) {
  reserve(scene, store);
  store.bind();
  triangles_.bind();
  beginBuild_.set("maxRequests", kMaxRequests);
  beginBuild_.set("blockCount", static_cast<GLuint>(blocksOf(scene, TRIANGLE_BLOCK)));
  beginBuild_.use();
  api_->DispatchCompute(1, 1, 1);
  // Arguments and counts (this dispatch) are read by all steps.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);

  dispatchForBuilds(clearBuilds_, offsetof(shared::BrickWork, groupsPerBuildX), store);

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
  bindRequests();
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
  for (const gl::Program* program : {&buildSmall_, &buildLarge_, &buildPaired_}) {
    store.grid().apply(*program);
    store.entryLayout().apply(*program);
  }
  scene.bindTriangles();
  counters_.bind();
  store.bind();
  bindRequests();
  brickBuilds_.bindStorage(SSBO_BRICK_BUILDS);
  triangles_.visit(buildSmall_, buildLarge_, store.grid().longestSide());
  // Counts and entries (the visit) are read by the next steps and the trace.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  dispatchForBuilds(buildPaired_, offsetof(shared::BrickWork, pairGroupsX), store);
}

void RunBuilder::followMoved(const GpuScene& scene, std::span<const VertexRange> moved, const RunStore& store) {
  if (!followMoved_) {
    followMoved_ = gl::Program::compute(*api_, "tracing/identity/follow_moved.comp");
    giveUpMoved_ = gl::Program::compute(*api_, "tracing/identity/give_up_moved.comp");
  }
  store.bind();
  const std::size_t words = (store.brickCount() + VOXELS_PER_WORD - 1) / VOXELS_PER_WORD;
  giveUpMoved_.set("wordCount", static_cast<GLuint>(words));
  dispatchFor(*api_, giveUpMoved_, words);
  // States and marks (this dispatch) are changed by the next one.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  const std::vector<VertexRange> ranges = mergeRanges(moved);
  const std::vector<std::uint32_t> blocks = scene.extents.blocksUsing(ranges);
  const gl::Buffer vertices = movedVertices(*api_, ranges, blocks);
  vertices.bindStorage(SSBO_MOVED_VERTICES);
  store.brickGrid().apply(followMoved_);
  followMoved_.set("ownAxis", store.ownAxis() ? 1 : 0);
  followMoved_.set("triangleCount", scene.triangleCount);
  scene.bindTriangles();
  blocks_.bindStorage(SSBO_TRIANGLE_BLOCKS);
  dispatchFor(*api_, followMoved_, blocks.size() * MOVED_BLOCK);
  // Boxes of blocks, states and the box of bricks (this dispatch) are read by what follows and by builds.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  store.boundEmpty();
}

void RunBuilder::releaseMemory() {
  triangles_.releaseMemory();
  requests_ = gl::Buffer();
  brickBuilds_ = gl::Buffer();
}

void RunBuilder::addMemory(TracerMemory& memory) const {
  memory.structureTotal += counters_.bytes() + blocks_.bytes();
  memory.transient = std::max(memory.transient, transient_);
}

}  // namespace halfsilver
