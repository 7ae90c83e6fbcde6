#include "tracing/identity/identity_tracer.h"

#include <algorithm>

namespace halfsilver {
namespace {

// Bricks on a waiting ray's way that are built with the one it waits for; doubled each time that rays wait again. Few
// and many small builds, or fewer builds of lists that nobody needs.
constexpr int kFirstLookAhead = 2;
constexpr int kKeptLookAhead = 16;  // if most bricks are there from earlier frames: another build costs more
constexpr int kMaxLookAhead = 4096;

}  // namespace

Method IdentityTracer::method() {
  return {{.name = "identity",
           .help = "fragments that name their triangle, exact ray/triangle test",
           .settings = {"voxels.resolution", "voxels.per_triangle", "voxels.axis", "abuffer.keep", "trace.stage"},
           .preset = "halfsilver",
           .knobs = {{"voxels.per_triangle", {"2", "4", "8", "16", "32", "64"}}}},
          [](const gl::Api& api, const Settings& settings) { return std::make_unique<IdentityTracer>(api, settings); }};
}

IdentityTracer::IdentityTracer(const gl::Api& api, const Settings& settings)
    : keep_(settings.identity.keep),
      store_(api, settings),
      builder_(api),
      tracePass_(api, settings.trace.stage, "tracing/identity", {}) {}

void IdentityTracer::update(const FrameView& view, const SceneChange& change) {
  store_.beginFrame();
  builder_.beginFrame();
  const bool kept = keep_ && built_ && store_.complete() && !change.topology;
  firstLookAhead_ = kKeptLookAhead;
  if (kept && change.moved.empty()) return;
  const Grid bricks = store_.brickGridOf(view.scene);
  built_ = false;  // until nothing has failed
  store_.setOuter(view.scene.extents.core().outer);
  if (kept && store_.ownAxis() && bricks == store_.brickGrid()) {
    const auto scope = view.profiler.section("voxelize");
    builder_.giveUpMoved(view.scene, change.moved, store_);
    if (!store_.compact(builder_.bytes())) builder_.clearCounters();
  } else {
    store_.start(view, bricks);
    builder_.clearCounters();
    firstLookAhead_ = kFirstLookAhead;
  }
  built_ = true;
}

void IdentityTracer::trace(const FrameView& view, const RayQueue& rays, Hits& hits) {
  const gl::Program& program = tracePass_.program();
  store_.grid().apply(program);
  int lookAhead = firstLookAhead_;
  program.set("lookAhead", lookAhead);
  program.set("maxRequests", RunBuilder::kMaxRequests);
  const auto bindStructure = [&] {
    store_.bind();
    store_.bindOuter();
  };
  const auto buildRequested = [&] {
    const auto scope = view.profiler.section("build");
    lookAhead = std::min(2 * lookAhead, kMaxLookAhead);
    program.set("lookAhead", lookAhead);
    return builder_.buildRequested(view.scene, store_);
  };
  built_ = false;  // a build that fails half way leaves nothing to keep
  tracePass_.run(view, rays, hits, {bindStructure, buildRequested});
  built_ = true;
  store_.shrink();
  builder_.releaseMemory();
}

TracerMemory IdentityTracer::memory() const {
  TracerMemory memory;
  store_.report(memory);
  builder_.addMemory(memory);
  memory.transient += tracePass_.bytes();
  return memory;
}

}  // namespace halfsilver
