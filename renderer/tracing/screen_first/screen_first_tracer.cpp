#include "tracing/screen_first/screen_first_tracer.h"

#include <algorithm>
#include <utility>

#include <halfsilver/shared_structs.h>
#include "shared/passes/screen.h"

namespace halfsilver {
namespace {

constexpr std::size_t kMaxQueues = 64;

void atLeast(const gl::Api& api, std::size_t bytes, const char* label, gl::Buffer& buffer) {
  if (buffer.bytes() >= bytes) return;
  buffer = gl::Buffer();  // the old memory goes before the new comes
  buffer = gl::Buffer(api, bytes, label);
}

}  // namespace

Method ScreenFirstTracer::method(const Method& structure) {
  MethodInfo info{.name = "screen-first",
                  .help = "the screen where it is certain, " + structure.info.name + " for all other rays",
                  .settings = structure.info.settings};
  std::erase(info.settings, "trace.count_work");  // what the screen does is not counted
  return {std::move(info), [make = structure.make](const gl::Api& api, Settings settings) {
            settings.trace.countWork = false;
            return std::make_unique<ScreenFirstTracer>(api, settings, make(api, settings));
          }};
}

ScreenFirstTracer::ScreenFirstTracer(const gl::Api& api, const Settings& settings, std::unique_ptr<Tracer> structure)
    : api_(&api),
      structure_(std::move(structure)),
      pyramid_(api),
      backFaces_(api),
      tracePass_(api, {.stage = settings.trace.stage}, "tracing/screen_first"),
      collect_(gl::Program::compute(api, "tracing/screen_first/collect.comp")),
      beginRest_(gl::Program::compute(api, "tracing/screen_first/begin_rest.comp")),
      return_(gl::Program::compute(api, "tracing/screen_first/return.comp")) {
  rest_.count = gl::Buffer(api, sizeof(shared::RayCount), "rest count");
  noAnswers_ = gl::Buffer(api, sizeof(GLuint), "no answers");
}

void ScreenFirstTracer::update(const FrameView& view, const SceneChange& change) {
  structure_->update(view, change);
  if (answers_.size() > kMaxQueues) answers_.clear();  // frames of other sizes had them
  if (change.any()) pyramid_.forget();
  const auto scope = view.profiler.section("build");
  if (pyramid_.holds(view)) return;
  grid_ = makeGrid(view.scene.extents.bounds(), 1, 1);
  pyramid_.build(view, backFaces_.draw(view));
}

const gl::Buffer* ScreenFirstTracer::answers(const RayQueue& rays) const {
  const auto found = answers_.find(&rays);
  return rays.ofPixels() && found != answers_.end() ? &found->second : nullptr;
}

// Returns where to note who answers.
gl::Buffer& ScreenFirstTracer::reserve(const RayQueue& rays) {
  rest_.capacity = rays.capacity;
  // Rows of 16 bytes.
  atLeast(*api_, std::max<std::size_t>(16, rays.rays.bytes()), "rest of the rays", rest_.rays);
  atLeast(*api_, rays.capacity * sizeof(shared::Hit), "hits of the rest", restHits_.hits);
  atLeast(*api_, rays.capacity * sizeof(GLuint), "places of the rest", restIndices_);
  if (!rays.ofPixels()) return noAnswers_;
  gl::Buffer& answers = answers_[&rays];
  atLeast(*api_, rays.capacity * sizeof(GLuint), "who answered", answers);
  return answers;
}

// Hits of the rays that the screen knows; the others become a queue.
void ScreenFirstTracer::askScreen(const FrameView& view, const RayQueue& rays, Hits& hits) {
  const gl::Buffer& answers = reserve(rays);
  grid_.apply(tracePass_.program());
  tracePass_.run(view, rays, hits, {.bind = [&] { pyramid_.bind(view); }, .certain = true});
  const auto scope = view.profiler.section("trace");
  rest_.count.fill(0);
  view.bindRays(rays);
  hits.hits.bindStorage(SSBO_HITS);
  rest_.rays.bindStorage(SSBO_REST_RAYS);
  rest_.count.bindStorage(SSBO_REST_COUNT);
  restIndices_.bindStorage(SSBO_REST_INDICES);
  answers.bindStorage(SSBO_ANSWERS);
  collect_.use();
  collect_.set("keepAnswers", rays.ofPixels() ? 1 : 0);
  api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, rays.count.name());
  api_->DispatchComputeIndirect(0);
  // The count (collect) becomes a dispatch.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  beginRest_.use();
  api_->DispatchCompute(1, 1, 1);
  // The queue (both) is read by the structure's method.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void ScreenFirstTracer::takeBack(const FrameView& view, const RayQueue& rays, const Hits& hits) const {
  const auto scope = view.profiler.section("trace");
  rays.count.bindStorage(SSBO_RAY_COUNT);
  hits.hits.bindStorage(SSBO_HITS);
  rest_.count.bindStorage(SSBO_REST_COUNT);
  restIndices_.bindStorage(SSBO_REST_INDICES);
  restHits_.hits.bindStorage(SSBO_REST_HITS);
  return_.use();
  api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, rest_.count.name());
  api_->DispatchComputeIndirect(0);
  // Hits and the count of overflows are read by shading and by the host.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void ScreenFirstTracer::trace(const FrameView& view, const RayQueue& rays, Hits& hits) {
  askScreen(view, rays, hits);
  structure_->trace(view, rest_, restHits_);
  takeBack(view, rays, hits);
}

void ScreenFirstTracer::occluded(const FrameView& view, const RayQueue& rays, Hits& hits) {
  askScreen(view, rays, hits);
  structure_->occluded(view, rest_, restHits_);
  takeBack(view, rays, hits);
}

TracerMemory ScreenFirstTracer::memory() const {
  TracerMemory memory = structure_->memory();
  memory.structureTotal += pyramid_.bytes() + backFaces_.bytes();
  memory.transient += tracePass_.bytes() + rest_.bytes() + restHits_.bytes() + restIndices_.bytes();
  for (const auto& [queue, answers] : answers_) memory.transient += answers.bytes();
  return memory;
}

}  // namespace halfsilver
